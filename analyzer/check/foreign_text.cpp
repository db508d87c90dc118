// Foreign text: counts the blocks that cannot be read and tells of them once.
#include "analyzer/check/foreign_text.h"

#include "analyzer/rule/rule_table.h"
#include "formats/text/formatted.h"

#include <set>

namespace ncvet {

namespace {

/// That many blocks, and that part of all, are no slips of the pen in a program of this control.
constexpr uint64_t fewestUnreadable = 10;
constexpr uint64_t unreadablePart = 6; // a sixth
/// And where somebody has named the control.
constexpr uint64_t fewestUnreadableOfNamed = 20;
constexpr uint64_t unreadablePartOfNamed = 5; // a fifth
/// The same where the text names another control by itself.
constexpr uint64_t fewestWrong = 3;
constexpr uint64_t wrongPart = 20; // a twentieth
/// What cannot be read where little speaks for the control.
constexpr uint64_t fewestOfGuess = 3;
constexpr uint64_t partOfGuess = 20; // a twentieth
/// Of codes that this control does not have fewer are enough.
constexpr uint64_t fewestCodes = 2;

/// What is wrong on every control, whoever reads it.
bool isWrongEverywhere(llvm::StringRef rule) {
  return rule == "syntax-unclosed-comment" || rule == "syntax-missing-decimal-point";
}

llvm::StringRef idOf(const Finding &finding) { return allRules()[finding.rule].info.id; }

/// What a control says to the language of another one: no block, no code, no word of its own.
bool isOfLanguage(const Finding &finding) {
  const RuleInfo &rule = allRules()[finding.rule].info;
  return (rule.category == "syntax" || rule.category == "block") && !isWrongEverywhere(rule.id);
}

bool isUnreadable(const Finding &finding) {
  return isOfLanguage(finding) && allRules()[finding.rule].info.category == "syntax";
}

/// The lines of one file with findings that are no advice.
struct WrongLines {
  std::set<uint32_t> all, ofLanguage, ofCodes, unreadable;
  std::set<uint32_t> unread;      ///< `unreadable`, and those of comments that nobody can read
  std::set<uint32_t> ofComments;  ///< with comments that nobody can read
  const Finding *first = nullptr; ///< the first that cannot be read, else the first
  const Finding *firstComment = nullptr;
  const Finding *firstCode = nullptr; ///< that is another control's
  const Finding *firstOfLanguage = nullptr;

  WrongLines(const LineIndex &lines, FileId file, llvm::ArrayRef<Finding> findings) {
    for (const Finding &finding : findings)
      if (finding.range.file == file && finding.severity != Severity::Style)
        add(finding, lines.lineBegin(finding.range.begin));
  }

  /// Broken comments are why most of it cannot be read, not another control's language.
  bool areComments() const { return ofComments.size() * 2 > unread.size(); }

private:
  void add(const Finding &finding, uint32_t line) {
    all.insert(line);
    if (isOfLanguage(finding)) {
      firstOfLanguage = firstOfLanguage ? firstOfLanguage : &finding;
      ofLanguage.insert(line);
    }
    if (allRules()[finding.rule].info.category == "block") {
      firstCode = firstCode ? firstCode : &finding;
      ofCodes.insert(line);
    }
    const bool isSyntax = isUnreadable(finding);
    if (isSyntax)
      unreadable.insert(line);
    const bool isComment = idOf(finding) == "syntax-unclosed-comment";
    if (isSyntax || isComment)
      unread.insert(line);
    if (isComment) {
      firstComment = firstComment ? firstComment : &finding;
      ofComments.insert(line);
    }
    if (!first || (isSyntax && !isUnreadable(*first)))
      first = &finding;
  }
};

bool areMany(const std::set<uint32_t> &lines, uint64_t blocks) {
  return lines.size() >= fewestUnreadable ||
         (lines.size() >= fewestWrong && lines.size() * wrongPart >= blocks);
}

bool areManyCodes(const std::set<uint32_t> &lines, uint64_t blocks) {
  return lines.size() >= fewestCodes && lines.size() * wrongPart >= blocks;
}

/// In a short text a block or two that cannot be read are enough.
bool areSome(const std::set<uint32_t> &lines, uint64_t blocks) {
  return !lines.empty() && lines.size() * wrongPart >= blocks;
}

/// What is told in place of the findings of a file.
struct Fold {
  OtherControl other; ///< its name is empty when the text is of none that is known
  uint64_t lines = 0;
  bool all = true;       ///< all findings go; else those of the language alone
  bool doubtful = false; ///< the control is not sure: it may be another one
};

/// A control with a table, or one that reads nearly the same, is another one only by what is not of
/// this one's language.
std::optional<Fold> foldInto(OtherControl other, const WrongLines &wrong, uint64_t blocks) {
  // Lines for a simulator are dropped, and the rest is a program of this control.
  if (other.name.empty() || (other.isAlike && other.isNoMachine))
    return std::nullopt;
  const bool areMost = areMany(wrong.ofLanguage, blocks) || areManyCodes(wrong.ofCodes, blocks);
  const uint64_t ofLanguage = wrong.ofLanguage.size();
  if (other.hasTable) {
    if (!areMost && wrong.ofCodes.size() < fewestCodes)
      return std::nullopt;
    return Fold{std::move(other), ofLanguage, areMost};
  }
  if (other.isAlike) {
    if (!areMost && !areSome(wrong.unreadable, blocks))
      return std::nullopt;
    return Fold{std::move(other), ofLanguage, false};
  }
  return Fold{std::move(other), ofLanguage ? ofLanguage : wrong.all.size(), true};
}

/// The finding that is told for all.
const Finding &toldForAll(const Fold &fold, const WrongLines &wrong) {
  if (fold.other.hasTable && wrong.firstCode)
    return *wrong.firstCode;
  if (fold.other.name.empty() && wrong.areComments())
    return *wrong.firstComment;
  if (wrong.firstOfLanguage && (!fold.all || !isUnreadable(*wrong.first)))
    return *wrong.firstOfLanguage;
  return *wrong.first;
}

/// Lines with something in them: of a text that the control does not read to its end they are as
/// good as blocks.
uint64_t filledLines(llvm::StringRef text) {
  uint64_t count = 0;
  while (!text.empty()) {
    const auto [line, rest] = text.split('\n');
    count += !line.trim().empty();
    text = rest;
  }
  return count;
}

std::string causeOf(const Fold &fold, const WrongLines &wrong) {
  const OtherControl &other = fold.other;
  if (other.name.empty() && wrong.areComments())
    return "cannot be read, most for their comments";
  if (other.name.empty())
    return fold.doubtful ? "cannot be read: the text may be for another control"
                         : "cannot be read: the text is no program of this control";
  return (fold.lines == 1 ? "is " : "are ") +
         ((other.isNoMachine ? "no program of a machine: " : "for another control: ") +
          other.name) +
         " (" + other.marks + ")";
}

/// A line that bears a mark of a control without a table is its command where the control was found
/// out; a simulator's lines are no blocks for anybody.
void dropItsCommands(const SourceFile &source, const TextOrigin &origin, bool alike,
                     std::vector<Finding> &findings) {
  const auto isUnread = [&](const Finding &finding) {
    return finding.range.file == source.id() && isUnreadable(finding);
  };
  if (llvm::none_of(findings, isUnread))
    return;
  const OtherControl other = origin.otherControl();
  if (other.isAlike != alike || !other.hasMark || !(origin.detected || other.isNoMachine))
    return;
  llvm::erase_if(findings, [&](const Finding &finding) {
    const uint32_t at = finding.range.begin;
    return isUnread(finding) && other.hasMark(source.text().slice(source.lines().lineBegin(at),
                                                                  source.lines().lineEnd(at)));
  });
}

/// Of a text for a control without a table nothing is told that rests on codes of the one as which
/// it is read: of one whose language is nearly the same, what programs, calls and modes are.
void dropJudgements(const SourceFile &source, const TextOrigin &origin,
                    std::vector<Finding> &findings) {
  if (!origin.detected || origin.sure || findings.empty())
    return;
  const OtherControl other = origin.otherControl();
  if (other.name.empty() || other.hasTable)
    return;
  llvm::erase_if(findings, [&](const Finding &finding) {
    return finding.range.file == source.id() &&
           !other.isTold(allRules()[finding.rule].info.category);
  });
}

} // namespace

void foldForeignText(Project &project, const FileUnit &unit, const TextOrigin &origin,
                     std::vector<Finding> &findings) {
  const FileId file = unit.source.id();
  const SourceFile &source = project.sources().get(file);
  dropItsCommands(source, origin, /*alike=*/true, findings);
  dropJudgements(source, origin, findings);
  const WrongLines wrong(source.lines(), file, findings);
  std::optional<Fold> fold;
  if (areMany(wrong.all, origin.blocks) || wrong.ofCodes.size() >= fewestCodes ||
      areSome(wrong.unreadable, origin.blocks) || wrong.unreadable.count(0))
    fold = foldInto(origin.otherControl(), wrong, origin.blocks);
  const uint64_t part = origin.detected ? unreadablePart : unreadablePartOfNamed;
  const uint64_t fewest = origin.detected ? fewestUnreadable : fewestUnreadableOfNamed;
  if (!fold && wrong.unread.size() >= fewest && wrong.unread.size() * part >= origin.blocks)
    fold = Fold{{}, wrong.unread.size(), true};
  if (!fold && origin.detected && !origin.sure && wrong.unreadable.size() >= fewestOfGuess &&
      wrong.unreadable.size() * partOfGuess >= origin.blocks)
    fold = Fold{{}, wrong.ofLanguage.size(), false, true};
  if (!fold)
    return dropItsCommands(source, origin, /*alike=*/false, findings);
  Finding one = toldForAll(*fold, wrong);
  const uint64_t blocks =
      fold->other.hasTable ? origin.blocks : std::max(origin.blocks, filledLines(source.text()));
  // Whose code it is the cause says.
  const bool same = !fold->other.name.empty() && idOf(one) == "block-foreign-dialect-code";
  one.message =
      formatted("{0} of {1} blocks {2}{3}{4}", fold->lines, std::max(blocks, fold->lines),
                causeOf(*fold, wrong), same ? "" : "; the first: ", same ? "" : one.message);
  one.severity = std::min(one.severity, fold->other.highest);
  one.fix.reset();
  llvm::erase_if(findings, [&](const Finding &finding) {
    const bool goes = fold->all ? !(fold->other.hasTable && isWrongEverywhere(idOf(finding)))
                                : isOfLanguage(finding);
    return finding.range.file == file && goes;
  });
  findings.insert(findings.begin(), std::move(one));
}

} // namespace ncvet
