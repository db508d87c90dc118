// Fixes: choosing those that go together, checking the outcome, writing files.
#include "analyzer/check/fix.h"

#include "analyzer/check/motion_record.h"

#include "llvm/Support/FileSystem.h"
#include "llvm/Support/Path.h"

#include <map>

namespace ncvet {

namespace {

/// Each cause is mended in a round of its own; a program with more of them is mended by a second
/// run, and that is said.
constexpr unsigned maxRounds = 100;
/// Rounds that were taken back, at most: a few rules at fault.
constexpr unsigned maxRefusals = 40;
/// Fixes that are tried one by one, at most, and bytes of text that this may read: an editor waits
/// for the answer.
constexpr size_t maxTried = 16, mostTriedBytes = 4 << 20;

/// One check of a text.
struct Attempt {
  std::unique_ptr<SourceSet> sources;
  const SourceFile *file = nullptr;
  FileOutcome outcome;
  MotionRecord motions;

  /// Findings by rule that are as severe as that, those in other files too: a fix must not break a
  /// caller's program.
  std::map<RuleId, unsigned> counts(Severity least) const {
    std::map<RuleId, unsigned> counts;
    for (const CheckedFinding &checked : outcome.findings)
      if (!checked.finding.suppressed && checked.finding.severity >= least)
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
    result.unsureControl = current.outcome.guessed && !current.outcome.sure;
    unsigned refusals = 0;
    // Nobody knows what a text means whose control is a guess.
    while (!result.unsureControl && result.rounds < maxRounds && refusals < maxRefusals) {
      const std::vector<const Finding *> chosen = choose(current);
      if (chosen.empty()) {
        if (!only_ && !first_)
          break;
        tryAll();
        continue;
      }
      if (!current.motions.isKnown())
        current.motions = record(current);
      std::optional<Attempt> next = afterFixes(current, chosen);
      if (!next) {
        ++refusals;
        refuse(chosen);
        continue;
      }
      if (!first_)
        only_.reset();
      ++result.rounds;
      result.applied += unsigned(chosen.size());
      for (const Finding *finding : chosen)
        ++result.byRule[finding->rule];
      current = std::move(*next);
    }
    result.refused = refused_.size();
    tryAll();
    result.stoppedEarly =
        (result.rounds == maxRounds || refusals == maxRefusals) && !choose(current).empty();
    result.text = current.file->text().str();
    return result;
  }

  std::set<FindingPlace> thatHold(llvm::ArrayRef<FindingPlace> findings) {
    Attempt current = check(original_.text());
    std::vector<const Finding *> wanted, together;
    for (const CheckedFinding &checked : current.outcome.findings)
      if (isWanted(checked.finding, current.file->id()) &&
          llvm::is_contained(findings, placeOf(checked.finding)))
        wanted.push_back(&checked.finding);
    if (wanted.empty())
      return {};
    current.motions = record(current);
    std::map<uint32_t, RuleId> ruleOfLine;
    std::map<uint32_t, const TextEdit *> edits;
    for (const Finding *finding : wanted)
      if (fits(*finding, *current.file, ruleOfLine, edits))
        together.push_back(finding);
    std::set<FindingPlace> held;
    if (afterFixes(current, together))
      for (const Finding *finding : together)
        held.insert(placeOf(*finding));
    const size_t most = std::min(maxTried, mostTriedBytes / (original_.text().size() + 1));
    size_t tried = 0;
    for (const Finding *finding : wanted)
      if (!held.count(placeOf(*finding)) && (together.size() > 1 || together[0] != finding) &&
          tried++ < most && afterFixes(current, finding))
        held.insert(placeOf(*finding));
    return held;
  }

private:
  static FindingPlace placeOf(const Finding &finding) {
    return {finding.rule, finding.range.begin, finding.range.end};
  }

  /// The text with these fixes; none: they do not hold what they say.
  std::optional<Attempt> afterFixes(const Attempt &before, llvm::ArrayRef<const Finding *> chosen) {
    const std::vector<TextEdit> edits = editsOf(chosen);
    Attempt after = check(applyEdits(before.file->text(), edits));
    after.motions = record(after);
    if (isWorse(before, after, chosen) || !mends(after, chosen, edits) ||
        !keepsItsPromise(before, after, chosen, edits))
      return std::nullopt;
    return after;
  }

  Attempt check(llvm::StringRef text) {
    Attempt attempt;
    attempt.sources = std::make_unique<SourceSet>(open_);
    attempt.file = &attempt.sources->add(original_.display(), text, original_.path());
    attempt.outcome = checkFile(session_, *attempt.sources, *attempt.file);
    return attempt;
  }

  MotionRecord record(Attempt &attempt) {
    return MotionRecord::of(session_, *attempt.sources, *attempt.file);
  }

  /// A safe fix changes nothing that the machine does. An unsafe one changes what its own block
  /// does and the block of its finding; all others do the same as before or, when a cycle is ended,
  /// less.
  static bool keepsItsPromise(const Attempt &before, const Attempt &after,
                              llvm::ArrayRef<const Finding *> chosen,
                              llvm::ArrayRef<TextEdit> edits) {
    if (before.motions.sameAs(after.motions))
      return true;
    const bool safe = llvm::all_of(
        chosen, [](const Finding *finding) { return finding->fix->safety == FixSafety::Safe; });
    if (safe)
      return false;
    std::vector<SourceRange> places;
    for (const Finding *finding : chosen)
      places.push_back(finding->range);
    return before.motions.onlyChangesBlocks(after.motions, edits, places);
  }

  /// Whether none of the findings is still at its place: what does not help is not done again and
  /// again.
  static bool mends(const Attempt &after, llvm::ArrayRef<const Finding *> chosen,
                    llvm::ArrayRef<TextEdit> edits) {
    std::set<std::pair<RuleId, uint32_t>> places;
    for (const CheckedFinding &checked : after.outcome.findings)
      if (checked.finding.range.file == after.file->id() && !checked.finding.suppressed)
        places.emplace(checked.finding.rule, checked.finding.range.begin);
    return llvm::none_of(chosen, [&](const Finding *finding) {
      return places.count({finding->rule, movedOffset(finding->range.begin, edits)}) > 0;
    });
  }

  bool isWanted(const Finding &finding, FileId file) const {
    return finding.fix && !finding.suppressed && !isRefused(finding) &&
           (!only_ || *only_ == finding.rule) &&
           (unsafe_ || finding.fix->safety == FixSafety::Safe) && !finding.fix->edits.empty() &&
           llvm::all_of(finding.fix->edits,
                        [&](const TextEdit &edit) { return edit.range.file == file; });
  }

  /// The first fixes by position that neither overlap nor share a line with another rule's, and one
  /// for each cause: when a cycle is ended once, it is ended for all findings that it has caused.
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
    std::set<std::tuple<FileId, uint32_t>> causes;
    for (const Finding *finding : wanted) {
      const bool isCaused = !finding->notes.empty();
      const std::tuple<FileId, uint32_t> cause =
          isCaused ? std::tuple(finding->notes[0].range.file, finding->notes[0].range.begin)
                   : std::tuple<FileId, uint32_t>();
      if ((isCaused && causes.count(cause)) || !fits(*finding, *attempt.file, ruleOfLine, edits))
        continue;
      if (isCaused)
        causes.insert(cause);
      chosen.push_back(finding);
      if (first_)
        break;
    }
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

  /// In the order of the text.
  static std::vector<TextEdit> editsOf(llvm::ArrayRef<const Finding *> chosen) {
    std::vector<TextEdit> edits;
    for (const Finding *finding : chosen)
      edits.insert(edits.end(), finding->fix->edits.begin(), finding->fix->edits.end());
    llvm::stable_sort(
        edits, [](const TextEdit &a, const TextEdit &b) { return a.range.begin < b.range.begin; });
    return edits;
  }

  /// More findings of a rule than before. What is mended may leave advice on the text as it then
  /// is, where it was more than advice itself.
  static bool isWorse(const Attempt &before, const Attempt &after,
                      llvm::ArrayRef<const Finding *> chosen) {
    const bool adviceAlone = llvm::any_of(
        chosen, [](const Finding *finding) { return finding->severity == Severity::Style; });
    const Severity least = adviceAlone ? Severity::Style : Severity::Warning;
    const std::map<RuleId, unsigned> old = before.counts(least);
    for (const auto &[rule, count] : after.counts(least)) {
      const auto known = old.find(rule);
      if (count > (known == old.end() ? 0 : known->second))
        return true;
    }
    return false;
  }

  void tryAll() {
    only_.reset();
    first_ = false;
  }

  /// Next time the first rule alone, then its first fix alone; a fix that was alone is left out for
  /// good.
  void refuse(llvm::ArrayRef<const Finding *> chosen) {
    const bool oneRule = llvm::all_of(
        chosen, [&](const Finding *finding) { return finding->rule == chosen.front()->rule; });
    if (chosen.size() == 1) {
      refused_.insert(nameOf(*chosen.front()));
    } else if (oneRule) {
      first_ = true;
    } else {
      only_ = chosen.front()->rule;
    }
  }

  /// A finding by its rule and what it says: its place changes from round to round.
  static std::pair<RuleId, std::string> nameOf(const Finding &finding) {
    return {finding.rule, finding.message};
  }
  bool isRefused(const Finding &finding) const { return refused_.count(nameOf(finding)) > 0; }

  Session &session_;
  const SourceFile &original_;
  const bool unsafe_;
  const std::shared_ptr<const SourceSet::Overlay> open_;
  std::optional<RuleId> only_; ///< the rule whose fixes are tried alone
  bool first_ = false;         ///< … and of these the first one alone
  std::set<std::pair<RuleId, std::string>> refused_;
};

} // namespace

FixedText fixText(Session &session, const SourceFile &file, bool unsafe,
                  const std::shared_ptr<const SourceSet::Overlay> &open) {
  return Fixer(session, file, unsafe, open).run();
}

std::set<FindingPlace> fixesThatHold(Session &session, const SourceFile &file,
                                     llvm::ArrayRef<FindingPlace> findings,
                                     const std::shared_ptr<const SourceSet::Overlay> &open) {
  return Fixer(session, file, /*unsafe=*/true, open).thatHold(findings);
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
