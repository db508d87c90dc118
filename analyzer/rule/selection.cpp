// Which rules run on a file when nobody says more than a profile.
#include "analyzer/rule/selection.h"

#include "analyzer/rule/rule_table.h"

namespace ncvet {

RuleSelection RuleSelection::defaults(const Dialect &dialect) {
  RuleSelection selection;
  for (const RuleEntry &entry : allRules()) {
    bool on = entry.info.enabledByDefault;
    const auto table = dialect.rules.find(entry.info.id);
    if (table != dialect.rules.end() && table->second.enabled)
      on = *table->second.enabled;
    selection.enabled.push_back(on);
  }
  selection.asked.resize(selection.enabled.size());
  selection.ignored.resize(selection.enabled.size());
  selection.severity.resize(selection.enabled.size());
  return selection;
}

RuleSelection RuleSelection::everything() {
  RuleSelection selection;
  selection.enabled.assign(allRules().size(), true);
  selection.asked = selection.enabled;
  selection.ignored.resize(selection.enabled.size());
  selection.severity.resize(selection.enabled.size());
  return selection;
}

} // namespace ncvet
