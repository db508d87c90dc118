// Rule settings: names of rules and categories resolved, layers applied one over the other.
#include "analyzer/rule/rule_settings.h"

#include "analyzer/rule/rule_page.h"
#include "analyzer/rule/rule_table.h"
#include "formats/dialect/json_reader.h"
#include "formats/text/failure.h"

#include "llvm/ADT/StringExtras.h"
#include "llvm/Support/FormatVariadic.h"

namespace ncvet {

namespace {

/// The nearest name, or nothing: the list of all rules is too long for a message.
std::string nearestRule(llvm::StringRef given) {
  std::vector<llvm::StringRef> known;
  for (const RuleEntry &entry : allRules())
    known.push_back(entry.info.id);
  const std::string text = suggest(given, known);
  return llvm::StringRef(text).startswith("; did") ? text : "; `ncvet rules` lists them";
}

} // namespace

llvm::Expected<std::vector<RuleId>> rulesNamed(llvm::StringRef name) {
  const llvm::ArrayRef<RuleEntry> rules = allRules();
  std::vector<RuleId> found;
  for (size_t i = 0; i < rules.size(); ++i)
    if (name == "all" || rules[i].info.id == name || rules[i].info.category == name)
      found.push_back(RuleId(i));
  if (found.empty())
    return failure("unknown rule \"" + name + "\"" + nearestRule(name));
  return found;
}

std::vector<RuleId> rulesCalled(llvm::StringRef name) {
  auto rules = rulesNamed(name);
  if (rules)
    return std::move(*rules);
  llvm::consumeError(rules.takeError());
  return {};
}

void applySettings(RuleSelection &selection, const RuleSettings &settings) {
  const auto each = [](llvm::StringRef name, auto &&function) {
    if (auto rules = rulesNamed(name))
      llvm::for_each(*rules, function);
    else
      llvm::consumeError(rules.takeError());
  };
  if (!settings.select.empty())
    selection.enabled.assign(selection.enabled.size(), false);
  for (const std::vector<std::string> *names : {&settings.select, &settings.extendSelect})
    for (const std::string &name : *names)
      each(name, [&](RuleId rule) { selection.enabled[rule] = selection.asked[rule] = true; });
  for (const std::string &name : settings.ignore)
    each(name, [&](RuleId rule) { selection.enabled[rule] = false; });
  for (const auto &choice : settings.severity)
    each(choice.first, [&](RuleId rule) { selection.severity[rule] = choice.second; });
  for (const RuleSettings::Number &number : settings.options)
    selection.options[number.rule][number.option] = number.value;
}

llvm::Error checkRuleOption(const RuleSettings::Number &number) {
  const auto entry = llvm::find_if(
      allRules(), [&](const RuleEntry &candidate) { return candidate.info.id == number.rule; });
  if (entry == allRules().end())
    return failure("unknown rule \"" + number.rule + "\"" + nearestRule(number.rule));
  const RulePage page = readRulePage(entry->info);
  if (page.options.empty())
    return failure("rule \"" + number.rule + "\" has no options");
  const auto option = llvm::find_if(
      page.options, [&](const RuleOption &candidate) { return candidate.name == number.option; });
  if (option == page.options.end()) {
    std::vector<llvm::StringRef> known;
    for (const RuleOption &candidate : page.options)
      known.push_back(candidate.name);
    return failure("unknown option \"" + number.option + "\" of rule \"" + number.rule + "\"" +
                   suggest(number.option, known));
  }
  if (option->min && number.value < *option->min)
    return failure("option \"" + number.option + "\" must be at least " +
                   llvm::formatv("{0}", *option->min).str());
  if (option->max && number.value > *option->max)
    return failure("option \"" + number.option + "\" must be at most " +
                   llvm::formatv("{0}", *option->max).str());
  return llvm::Error::success();
}

} // namespace ncvet
