// Rule settings: names of rules and categories resolved, layers applied one over the other.
#include "analyzer/rule/rule_settings.h"

#include "analyzer/rule/rule_page.h"
#include "analyzer/rule/rule_table.h"
#include "formats/dialect/json_reader.h"
#include "formats/dialect/records.h"
#include "formats/text/failure.h"
#include "formats/text/number_text.h"

#include "llvm/ADT/StringExtras.h"
#include <nlohmann/json.hpp>

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

llvm::Expected<OptionValue> readFlag(llvm::StringRef name, const Json &value) {
  if (value.is_boolean())
    return OptionValue(double(value.get<bool>()));
  if (value.is_number() && (value == 0 || value == 1)) // as older files have it
    return OptionValue(value.get<double>());
  return failure("option \"" + name + "\" is true or false");
}

llvm::Expected<OptionValue> readNumber(const RuleOption &option, const Json &value) {
  if (!value.is_number())
    return failure("a number is expected");
  const double number = value.get<double>();
  if (option.min && number < *option.min)
    return failure("option \"" + option.name + "\" must be at least " + shortNumber(*option.min));
  if (option.max && number > *option.max)
    return failure("option \"" + option.name + "\" must be at most " + shortNumber(*option.max));
  return OptionValue(number);
}

llvm::Expected<OptionValue> readChoice(const RuleOption &option, const Json &value) {
  if (value.is_number()) { // as older files have it
    for (size_t index = 0; index < option.names.size(); ++index)
      if (value == index)
        return OptionValue(double(index));
  } else if (value.is_string() &&
             llvm::is_contained(option.names, value.get_ref<const std::string &>())) {
    return OptionValue(value.get<std::string>());
  }
  return failure("option \"" + option.name + "\" is one of " + llvm::join(option.names, ", "));
}

/// A text that should be the name of a rule.
void checkName(JsonReader &in, const Json &told) {
  if (!told.is_string())
    return;
  if (const std::string name = told.get<std::string>(); !findRule(name))
    in.fail(told, "unknown rule \"" + name + "\"" + nearestRule(name));
}

/// The options of the rules that a table, or one of its controls, names.
void checkRules(JsonReader &in, const Json &table) {
  const Json *rules = in.member(table, "rules");
  if (!rules || !rules->is_object())
    return;
  for (auto rule = rules->begin(); rule != rules->end(); ++rule) {
    if (!findRule(rule.key()))
      in.fail(*rule, "unknown rule \"" + rule.key() + "\"" + nearestRule(rule.key()));
    if (!rule->is_object())
      continue;
    if (const Json *told = in.member(*rule, "toldAs"))
      checkName(in, *told);
    if (const Json *told = in.member(*rule, "toldAt"); told && told->is_object())
      for (const Json &name : *told)
        checkName(in, name);
    for (auto option = rule->begin(); option != rule->end(); ++option)
      if (!isFieldOf(ruleRecord, option.key()) && !option->is_null())
        if (auto value = readRuleOption(rule.key(), option.key(), *option); !value)
          in.fail(*option, llvm::toString(value.takeError()));
  }
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
      each(name, [&](RuleId rule) {
        selection.enabled[rule] = selection.asked[rule] = true;
        selection.ignored[rule] = false;
      });
  for (const std::string &name : settings.ignore)
    each(name, [&](RuleId rule) {
      selection.enabled[rule] = false;
      selection.ignored[rule] = true;
    });
  for (const auto &choice : settings.severity)
    each(choice.first, [&](RuleId rule) { selection.severity[rule] = choice.second; });
  for (const RuleSettings::Option &option : settings.options)
    selection.options[option.rule][option.name] = option.value;
}

llvm::Expected<OptionValue> readRuleOption(llvm::StringRef rule, llvm::StringRef name,
                                           const nlohmann::json &value) {
  const auto entry = llvm::find_if(
      allRules(), [&](const RuleEntry &candidate) { return candidate.info.id == rule; });
  if (entry == allRules().end())
    return failure("unknown rule \"" + rule + "\"" + nearestRule(rule));
  const RulePage page = readRulePage(entry->info);
  if (page.options.empty())
    return failure("rule \"" + rule + "\" has no options");
  const auto option = llvm::find_if(
      page.options, [&](const RuleOption &candidate) { return candidate.name == name; });
  if (option == page.options.end()) {
    std::vector<llvm::StringRef> known;
    for (const RuleOption &candidate : page.options)
      known.push_back(candidate.name);
    return failure("unknown option \"" + name + "\" of rule \"" + rule + "\"" +
                   suggest(name, known));
  }
  switch (option->type) {
  case RuleOption::Type::Flag:
    return readFlag(name, value);
  case RuleOption::Type::Choice:
    return readChoice(*option, value);
  case RuleOption::Type::Number:
    break;
  }
  return readNumber(*option, value);
}

llvm::Error checkRulesOfTable(llvm::StringRef file, llvm::StringRef text) {
  auto json = parseJson(file, text);
  if (!json)
    return json.takeError();
  const JsonLayer layer{file.str(), text};
  JsonReader in(layer, *json);
  checkRules(in, *json);
  if (const Json *controls = in.member(*json, "controls"); controls && controls->is_object())
    for (const Json &control : *controls)
      checkRules(in, control);
  return in.takeError();
}

} // namespace ncvet
