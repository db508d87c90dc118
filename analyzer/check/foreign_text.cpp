// Foreign text: counts the blocks that cannot be read and tells of them once.
#include "analyzer/check/foreign_text.h"

#include "analyzer/rule/rule_table.h"

#include "llvm/Support/FormatVariadic.h"

#include <set>

namespace ncvet {

namespace {

/// That many blocks, and that part of all, are no slips of the pen in a program of this control.
constexpr uint64_t fewestUnreadable = 10;
constexpr uint64_t unreadablePart = 6; // a sixth
/// The same where the text names another control by itself.
constexpr uint64_t fewestWrong = 3;
constexpr uint64_t wrongPart = 20; // a twentieth

bool isSyntax(const Finding &finding) {
  return allRules()[finding.rule].info.category == "syntax" && finding.severity != Severity::Style;
}

} // namespace

void foldForeignText(Project &project, const FileUnit &unit, const TextOrigin &origin,
                     std::vector<Finding> &findings) {
  const FileId file = unit.source.id();
  const LineIndex &lines = project.sources().get(file).lines();
  std::set<uint32_t> unreadable, wrong;
  const Finding *first = nullptr;
  for (const Finding &finding : findings) {
    if (finding.range.file != file || finding.severity == Severity::Style)
      continue;
    const uint32_t line = lines.lineBegin(finding.range.begin);
    wrong.insert(line);
    if (isSyntax(finding))
      unreadable.insert(line);
    if (!first || (isSyntax(finding) && !isSyntax(*first)))
      first = &finding;
  }
  std::string other;
  const bool manyWrong = wrong.size() >= fewestUnreadable ||
                         (wrong.size() >= fewestWrong && wrong.size() * wrongPart >= origin.blocks);
  if (manyWrong)
    other = origin.otherControl();
  if (other.empty() && (!origin.detected || unreadable.size() < fewestUnreadable ||
                        unreadable.size() * unreadablePart < origin.blocks))
    return;
  Finding one = *first;
  const std::set<uint32_t> &counted = other.empty() ? unreadable : wrong;
  one.message += llvm::formatv("; {0} blocks are wrong here: ", counted.size());
  one.message += other.empty() ? "the text is no program of this control"
                               : "the text is for another control (" + other + ")";
  one.fix.reset();
  llvm::erase_if(findings, [&](const Finding &finding) { return finding.range.file == file; });
  findings.insert(findings.begin(), std::move(one));
}

} // namespace ncvet
