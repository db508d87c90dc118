// Repeats: findings of the same words, folded into the first of them.
#include "analyzer/check/fold_repeats.h"

#include "analyzer/rule/rule_page.h"
#include "analyzer/rule/rule_table.h"
#include "formats/text/formatted.h"

#include "llvm/ADT/StringExtras.h"
#include "llvm/ADT/StringMap.h"

#include <map>

namespace ncvet {

namespace {

/// Further places that a reader is shown; the number of all of them is in the message.
constexpr size_t mostNotes = 8;
/// More findings alike of one rule in one file are no slips of single blocks.
constexpr size_t many = 10;

/// The message without its numbers.
std::string withoutNumbers(llvm::StringRef message) {
  std::string text;
  for (const char c : message)
    if (!llvm::isDigit(c) && !llvm::StringRef("+-.").contains(c))
      text += c;
  return text;
}

void fold(const std::vector<Finding *> &group, RepeatedFindings repeated) {
  Finding &first = *group.front();
  const bool differs =
      repeated == RepeatedFindings::Alike && llvm::any_of(group, [&](const Finding *further) {
        return further->message != first.message;
      });
  for (Finding *further : llvm::makeArrayRef(group).drop_front()) {
    if (first.notes.size() < mostNotes)
      first.notes.push_back({further->range, "here too"});
    if (first.fix && further->fix && first.fix->safety == further->fix->safety)
      llvm::append_range(first.fix->edits, further->fix->edits);
    further->message.clear(); // taken out by the caller
  }
  const size_t others = group.size() - 1;
  if (differs)
    first.message += others == 1 ? "; one more like it in this file"
                                 : formatted("; {0} more like it in this file", others);
  else
    first.message += others == 1 ? "; once more in this file"
                                 : formatted("; {0} more times in this file", others);
  if (repeated == RepeatedFindings::Many)
    first.message += ": the whole text is made so";
}

} // namespace

void foldRepeats(std::vector<Finding> &findings) {
  std::map<RuleId, size_t> counts;
  for (const Finding &finding : findings)
    ++counts[finding.rule];
  std::map<std::pair<RuleId, std::string>, std::vector<Finding *>> groups;
  for (Finding &finding : findings) {
    if (finding.suppressed || counts[finding.rule] < 2)
      continue;
    const RepeatedFindings repeated = rulePage(finding.rule).repeated;
    if (repeated == RepeatedFindings::Each)
      continue;
    const std::string said =
        repeated == RepeatedFindings::Same ? finding.message : withoutNumbers(finding.message);
    groups[{finding.rule, formatted("{0} {1} {2} {3}", finding.range.file,
                                    unsigned(finding.severity), unsigned(finding.certainty), said)}]
        .push_back(&finding);
  }
  bool folded = false;
  for (auto &[key, group] : groups) {
    const RepeatedFindings repeated = rulePage(key.first).repeated;
    if (group.size() > (repeated == RepeatedFindings::Many ? many : 1)) {
      fold(group, repeated);
      folded = true;
    }
  }
  if (folded)
    llvm::erase_if(findings, [](const Finding &finding) { return finding.message.empty(); });
}

} // namespace ncvet
