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

/// A fault that is one in the language of any control: it is told by itself.
bool isOfAnyControl(const Finding &finding) {
  const llvm::StringRef id = allRules()[finding.rule].info.id;
  return id == "syntax-unclosed-comment" || id == "syntax-missing-decimal-point";
}

/// What a control says to the language of another one: no block, no code, no word of its own.
bool isOfLanguage(const Finding &finding) {
  const llvm::StringRef category = allRules()[finding.rule].info.category;
  return category == "syntax" || category == "block";
}

/// The lines of one file with findings that are no advice.
struct WrongLines {
  std::set<uint32_t> all, ofLanguage, ofCodes, unreadable;
  const Finding *first = nullptr;     ///< the first that cannot be read, else the first
  const Finding *firstCode = nullptr; ///< that is another control's

  WrongLines(const LineIndex &lines, FileId file, llvm::ArrayRef<Finding> findings) {
    for (const Finding &finding : findings)
      if (finding.range.file == file && finding.severity != Severity::Style)
        add(finding, lines.lineBegin(finding.range.begin));
  }

private:
  void add(const Finding &finding, uint32_t line) {
    all.insert(line);
    if (isOfLanguage(finding) && !isOfAnyControl(finding))
      ofLanguage.insert(line);
    if (allRules()[finding.rule].info.category == "block") {
      firstCode = firstCode ? firstCode : &finding;
      ofCodes.insert(line);
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

/// Of codes that this control does not have fewer are enough.
bool areManyCodes(const std::set<uint32_t> &lines, uint64_t blocks) {
  constexpr uint64_t fewest = 2;
  return lines.size() >= fewest && lines.size() * wrongPart >= blocks;
}

/// In a short text a block or two that cannot be read are enough.
bool areSome(const std::set<uint32_t> &lines, uint64_t blocks) {
  return !lines.empty() && lines.size() * wrongPart >= blocks;
}

} // namespace

void foldForeignText(Project &project, const FileUnit &unit, const TextOrigin &origin,
                     std::vector<Finding> &findings) {
  const FileId file = unit.source.id();
  const WrongLines wrong(project.sources().get(file).lines(), file, findings);
  OtherControl other;
  const std::set<uint32_t> *counted = nullptr;
  if (areMany(wrong.all, origin.blocks) || areManyCodes(wrong.ofCodes, origin.blocks) ||
      areSome(wrong.unreadable, origin.blocks) || wrong.unreadable.count(0)) {
    other = origin.otherControl();
    // A control with a table is another one only by what is not of this one's language.
    if (!other.name.empty() && (!other.hasTable || areMany(wrong.ofLanguage, origin.blocks) ||
                                areManyCodes(wrong.ofCodes, origin.blocks)))
      counted = other.hasTable ? &wrong.ofLanguage : &wrong.all;
  }
  const uint64_t part = origin.detected ? unreadablePart : unreadablePartOfNamed;
  const uint64_t fewest = origin.detected ? fewestUnreadable : fewestUnreadableOfNamed;
  if (!counted && wrong.unreadable.size() >= fewest &&
      wrong.unreadable.size() * part >= origin.blocks) {
    other = {};
    counted = &wrong.unreadable;
  }
  if (!counted)
    return;
  const bool byCode = other.hasTable && wrong.firstCode;
  Finding one = byCode ? *wrong.firstCode : *wrong.first;
  const std::string cause =
      other.name.empty() ? "cannot be read: the text is no program of this control"
                         : "are for another control: " + other.name + " (" + other.marks + ")";
  one.message = formatted("{0} of {1} blocks {2}; the first: {3}", counted->size(),
                          std::max<uint64_t>(origin.blocks, counted->size()), cause, one.message);
  one.fix.reset();
  llvm::erase_if(findings, [&](const Finding &finding) {
    return finding.range.file == file && !(other.hasTable && isOfAnyControl(finding));
  });
  findings.insert(findings.begin(), std::move(one));
}

} // namespace ncvet
