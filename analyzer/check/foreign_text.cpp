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
/// And where somebody has named the control.
constexpr uint64_t fewestUnreadableOfNamed = 20;
constexpr uint64_t unreadablePartOfNamed = 5; // a fifth
/// The same where the text names another control by itself.
constexpr uint64_t fewestWrong = 3;
constexpr uint64_t wrongPart = 20; // a twentieth

/// So many blocks that no control reads, among so many with words that are wrong, in a text of so
/// many blocks for each of them: whatever the text is for, it is no program that somebody runs.
constexpr uint64_t fewestMixedUnreadable = 4;
constexpr uint64_t fewestMixed = 6;
constexpr uint64_t mixedPart = 8; // an eighth
constexpr size_t fewestKinds = 2; // of faults: one and the same in many blocks is a habit
/// The same where hardly two faults are alike: somebody tries out what can be wrong.
constexpr uint64_t fewestVaried = 4;
constexpr uint64_t variedPart = 16; // a sixteenth
constexpr size_t manyKinds = 4;

/// What a control says to the language of another one: no block, no code, no word of its own.
bool isOfLanguage(const Finding &finding) {
  const llvm::StringRef category = allRules()[finding.rule].info.category;
  return category == "syntax" || category == "block";
}

/// The lines of one file with findings that are no advice.
struct WrongLines {
  std::set<uint32_t> all, ofLanguage, unreadable;
  std::set<RuleId> kinds;         ///< the rules that speak of the language
  const Finding *first = nullptr; ///< the first that cannot be read, else the first

  WrongLines(const LineIndex &lines, FileId file, llvm::ArrayRef<Finding> findings) {
    for (const Finding &finding : findings)
      if (finding.range.file == file && finding.severity != Severity::Style)
        add(finding, lines.lineBegin(finding.range.begin));
  }

private:
  void add(const Finding &finding, uint32_t line) {
    all.insert(line);
    if (isOfLanguage(finding)) {
      ofLanguage.insert(line);
      kinds.insert(finding.rule);
    }
    const bool isSyntax = allRules()[finding.rule].info.category == "syntax";
    if (isSyntax)
      unreadable.insert(line);
    if (!first || (isSyntax && unreadable.size() == 1 && !firstIsSyntax_)) {
      first = &finding;
      firstIsSyntax_ = isSyntax;
    }
  }

  bool firstIsSyntax_ = false;
};

bool areMany(const std::set<uint32_t> &lines, uint64_t blocks) {
  return lines.size() >= fewestUnreadable ||
         (lines.size() >= fewestWrong && lines.size() * wrongPart >= blocks);
}

/// In a short text a block or two that cannot be read are enough.
bool areSome(const std::set<uint32_t> &lines, uint64_t blocks) {
  return !lines.empty() && lines.size() * wrongPart >= blocks;
}

/// Faults of several kinds in a good part of the text.
bool areMixed(const WrongLines &wrong, uint64_t blocks) {
  const uint64_t lines = wrong.ofLanguage.size();
  const bool varied = wrong.kinds.size() >= manyKinds && lines >= fewestVaried &&
                      wrong.unreadable.size() + 1 >= fewestVaried && lines * variedPart >= blocks;
  return varied || (wrong.unreadable.size() >= fewestMixedUnreadable && lines >= fewestMixed &&
                    wrong.kinds.size() >= fewestKinds && lines * mixedPart >= blocks);
}

} // namespace

void foldForeignText(Project &project, const FileUnit &unit, const TextOrigin &origin,
                     std::vector<Finding> &findings) {
  const FileId file = unit.source.id();
  const WrongLines wrong(project.sources().get(file).lines(), file, findings);
  OtherControl other;
  const std::set<uint32_t> *counted = nullptr;
  if (areMany(wrong.all, origin.blocks) || areSome(wrong.unreadable, origin.blocks)) {
    other = origin.otherControl();
    // A control with a table is another one only by what is not of this one's language.
    if (!other.name.empty() && (!other.hasTable || areMany(wrong.ofLanguage, origin.blocks)))
      counted = other.hasTable ? &wrong.ofLanguage : &wrong.all;
  }
  const uint64_t part = origin.detected ? unreadablePart : unreadablePartOfNamed;
  const uint64_t fewest = origin.detected ? fewestUnreadable : fewestUnreadableOfNamed;
  if (!counted && wrong.unreadable.size() >= fewest &&
      wrong.unreadable.size() * part >= origin.blocks) {
    other = {};
    counted = &wrong.unreadable;
  }
  const bool mixed = !counted && areMixed(wrong, origin.blocks);
  if (mixed) {
    other = {};
    counted = &wrong.ofLanguage;
  }
  if (!counted)
    return;
  Finding one = *wrong.first;
  const std::string cause =
      mixed                ? "are not as this control reads them, for several reasons"
      : other.name.empty() ? "cannot be read: the text is no program of this control"
                           : "are for another control: " + other.name + " (" + other.marks + ")";
  one.message =
      llvm::formatv("{0} of {1} blocks {2}; the first: {3}", counted->size(),
                    std::max<uint64_t>(origin.blocks, counted->size()), cause, one.message);
  one.fix.reset();
  llvm::erase_if(findings, [&](const Finding &finding) { return finding.range.file == file; });
  findings.insert(findings.begin(), std::move(one));
}

} // namespace ncvet
