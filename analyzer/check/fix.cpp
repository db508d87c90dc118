// Fixes: choosing those that go together, checking the outcome, writing files.
#include "analyzer/check/fix.h"

#include "llvm/Support/FileSystem.h"
#include "llvm/Support/Path.h"

#include <map>
#include <set>

namespace ncvet {

namespace {

constexpr unsigned maxRounds = 10;
/// Rounds that led to new findings and were taken back, at most: one or two rules at fault.
constexpr unsigned maxRefusals = 20;

/// One check of a text.
struct Attempt {
  std::unique_ptr<SourceSet> sources;
  const SourceFile *file = nullptr;
  FileOutcome outcome;

  /// Findings by rule, those in other files too: a fix must not break a caller's program.
  std::map<RuleId, unsigned> counts() const {
    std::map<RuleId, unsigned> counts;
    for (const CheckedFinding &checked : outcome.findings)
      if (!checked.finding.suppressed)
        ++counts[checked.finding.rule];
    return counts;
  }
};

class Fixer {
public:
  Fixer(Session &session, const SourceFile &original, bool unsafe,
        std::shared_ptr<const SourceSet::Overlay> open)
      : session_(session), original_(original), unsafe_(unsafe), open_(std::move(open)) {}

  FixedText run() {
    FixedText result;
    Attempt current = check(original_.text());
    unsigned refusals = 0;
    while (result.rounds < maxRounds && refusals < maxRefusals) {
      const std::vector<const Finding *> chosen = choose(current);
      if (chosen.empty()) {
        if (!only_)
          break;
        only_.reset();
        continue;
      }
      Attempt next = check(apply(current, chosen));
      if (isWorse(current, next)) {
        ++refusals;
        refuse(chosen);
        continue;
      }
      only_.reset();
      ++result.rounds;
      result.applied += unsigned(chosen.size());
      current = std::move(next);
    }
    result.text = current.file->text().str();
    return result;
  }

private:
  Attempt check(llvm::StringRef text) {
    Attempt attempt;
    attempt.sources = std::make_unique<SourceSet>(open_);
    attempt.file = &attempt.sources->add(original_.display(), text, original_.path());
    attempt.outcome = checkFile(session_, *attempt.sources, *attempt.file);
    return attempt;
  }

  bool isWanted(const Finding &finding, FileId file) const {
    return finding.fix && !finding.suppressed && !refused_.count(finding.rule) &&
           (!only_ || *only_ == finding.rule) &&
           (unsafe_ || finding.fix->safety == FixSafety::Safe) && !finding.fix->edits.empty() &&
           llvm::all_of(finding.fix->edits,
                        [&](const TextEdit &edit) { return edit.range.file == file; });
  }

  /// The first fixes by position that neither overlap nor share a line with another rule's.
  std::vector<const Finding *> choose(const Attempt &attempt) const {
    std::vector<const Finding *> wanted;
    for (const CheckedFinding &checked : attempt.outcome.findings)
      if (isWanted(checked.finding, attempt.file->id()))
        wanted.push_back(&checked.finding);
    llvm::stable_sort(wanted, [](const Finding *a, const Finding *b) {
      return a->fix->edits.front().range.begin < b->fix->edits.front().range.begin;
    });
    std::vector<const Finding *> chosen;
    std::map<uint32_t, RuleId> ruleOfLine;
    std::map<uint32_t, const TextEdit *> edits; // by begin
    for (const Finding *finding : wanted)
      if (fits(*finding, *attempt.file, ruleOfLine, edits))
        chosen.push_back(finding);
    return chosen;
  }

  static bool fits(const Finding &finding, const SourceFile &file,
                   std::map<uint32_t, RuleId> &ruleOfLine,
                   std::map<uint32_t, const TextEdit *> &edits) {
    std::set<uint32_t> lines;
    for (const TextEdit &edit : finding.fix->edits) {
      const uint32_t last = file.lines().lineOf(edit.range.end);
      for (uint32_t line = file.lines().lineOf(edit.range.begin); line <= last; ++line) {
        const auto taken = ruleOfLine.find(line);
        if (taken != ruleOfLine.end() && taken->second != finding.rule)
          return false;
        lines.insert(line);
      }
      // Those taken do not overlap each other: only the neighbours can touch this one.
      auto following = edits.lower_bound(edit.range.begin);
      if (following != edits.end() && touches(*following->second, edit))
        return false;
      if (following != edits.begin() && touches(*std::prev(following)->second, edit))
        return false;
    }
    for (const TextEdit &edit : finding.fix->edits)
      edits[edit.range.begin] = &edit;
    for (const uint32_t line : lines)
      ruleOfLine[line] = finding.rule;
    return true;
  }

  static bool touches(const TextEdit &a, const TextEdit &b) {
    return overlaps(a, b) || a.range.begin == b.range.begin;
  }

  static std::string apply(const Attempt &attempt, llvm::ArrayRef<const Finding *> chosen) {
    std::vector<TextEdit> edits;
    for (const Finding *finding : chosen)
      edits.insert(edits.end(), finding->fix->edits.begin(), finding->fix->edits.end());
    return applyEdits(attempt.file->text(), edits);
  }

  static bool isWorse(const Attempt &before, const Attempt &after) {
    const std::map<RuleId, unsigned> old = before.counts();
    for (const auto &[rule, count] : after.counts()) {
      const auto known = old.find(rule);
      if (count > (known == old.end() ? 0 : known->second))
        return true;
    }
    return false;
  }

  /// Next time the first rule alone; a rule that was alone is left out for good.
  void refuse(llvm::ArrayRef<const Finding *> chosen) {
    const bool alone = llvm::all_of(
        chosen, [&](const Finding *finding) { return finding->rule == chosen.front()->rule; });
    if (alone) {
      refused_.insert(chosen.front()->rule);
      only_.reset();
    } else {
      only_ = chosen.front()->rule;
    }
  }

  Session &session_;
  const SourceFile &original_;
  const bool unsafe_;
  const std::shared_ptr<const SourceSet::Overlay> open_;
  std::optional<RuleId> only_;
  std::set<RuleId> refused_;
};

} // namespace

FixedText fixText(Session &session, const SourceFile &file, bool unsafe,
                  const std::shared_ptr<const SourceSet::Overlay> &open) {
  return Fixer(session, file, unsafe, open).run();
}

llvm::Error replaceFile(llvm::StringRef path, llvm::StringRef text) {
  namespace fs = llvm::sys::fs;
  const auto cannotWrite = [&](const llvm::Twine &why) {
    return failure("cannot write " + path + ": " + why);
  };
  llvm::SmallString<256> target;
  if (const std::error_code error = fs::real_path(path, target))
    return cannotWrite(error.message());
  auto permissions = fs::getPermissions(target);
  if (!permissions)
    return cannotWrite(permissions.getError().message());
  if (const std::error_code error = fs::access(target, fs::AccessMode::Write))
    return cannotWrite(error.message());
  auto temporary = fs::TempFile::create(target + "-%%%%%%");
  if (!temporary)
    return cannotWrite(llvm::toString(temporary.takeError()));
  llvm::raw_fd_ostream out(temporary->FD, /*shouldClose=*/false);
  out << text;
  out.flush();
  std::error_code error = out.error();
  out.clear_error();
  if (!error)
    error = fs::setPermissions(temporary->TmpName, *permissions);
  if (error) {
    llvm::consumeError(temporary->discard());
    return cannotWrite(error.message());
  }
  if (llvm::Error wrong = temporary->keep(target))
    return cannotWrite(llvm::toString(std::move(wrong)));
  return llvm::Error::success();
}

} // namespace ncvet
