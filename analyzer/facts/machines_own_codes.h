// Codes that only the machine may know, told once for each file.
#pragma once

#include "analyzer/rule/rule.h"

#include <map>

namespace ncvet {

/// The codes of a program that the table lacks, where the machine may have them all: by code, where
/// each was met first.
class MachinesOwnCodes {
public:
  void meet(int64_t code, SourceRange where) {
    const auto [entry, fresh] = first_.try_emplace(code, where);
    if (!fresh && entry->second.file == where.file && where.begin < entry->second.begin)
      entry->second = where;
  }

  /// One finding for each file, at the first of its codes. `known` says where a code would be
  /// known: "a code of this control nor remapped in the machine profile".
  void report(RuleContext &ctx, llvm::StringRef known) const {
    std::map<TextPlace, SourceRange> ordered;
    for (const auto &[code, range] : first_)
      ordered.emplace(TextPlace{range.file, range.begin}, range);
    for (auto at = ordered.begin(); at != ordered.end();) {
      const FileId file = at->first.file;
      const auto begin = at;
      while (at != ordered.end() && at->first.file == file)
        ++at;
      reportFile(begin, at, ctx, known);
    }
  }

  const auto &remembered() const { return first_; }

private:
  using Place = std::map<TextPlace, SourceRange>::const_iterator;

  /// The program is in a folder or a file whose name says that codes are remapped there: the
  /// machine's INI file has them.
  static bool isAmongRemaps(llvm::StringRef path) {
    constexpr unsigned near = 4; // the file and the folders above it
    for (unsigned up = 0; up < near && !path.empty(); ++up) {
      const auto [above, name] = path.rsplit('/');
      const bool last = above.size() == path.size();
      if ((last ? path : name).contains_insensitive("remap"))
        return true;
      path = last ? llvm::StringRef() : above;
    }
    return false;
  }

  static void reportFile(Place first, Place end, RuleContext &ctx, llvm::StringRef known) {
    const auto others = size_t(std::distance(first, end)) - 1;
    auto finding = ctx.report(first->second);
    if (!finding)
      return;
    if (isAmongRemaps(ctx.unitOf(first->first.file).source.display()))
      finding.severity(Severity::Style);
    if (others == 0)
      finding.message("`{0}` is neither {1}: what it does is not known", ctx.text(first->second),
                      known);
    else
      finding.message("`{0}` is neither {1}, and neither {2} {3} more: what they do is not known",
                      ctx.text(first->second), known, others == 1 ? "is" : "are", others);
    constexpr size_t mostNotes = 8; // as many as a reader is shown of findings alike
    size_t notes = 0;
    for (Place at = std::next(first); at != end && notes < mostNotes; ++at, ++notes)
      finding.note(at->second, "nor is this one");
  }

  std::map<int64_t, SourceRange> first_;
};

} // namespace ncvet
