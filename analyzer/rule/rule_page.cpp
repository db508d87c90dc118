// A rule's page: the fenced JSON block at its head, and what follows.
#include "analyzer/rule/rule_page.h"

#include "analyzer/rule/rule_table.h"
#include "formats/finding/page_text.h"

#include "llvm/ADT/STLExtras.h"
#include <nlohmann/json.hpp>

#include <map>
#include <mutex>

namespace ncvet {

namespace {

using PageJson = nlohmann::ordered_json;

std::optional<double> numberOf(const PageJson &object, const char *key) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_number())
    return std::nullopt;
  return found->get<double>();
}

RuleOption readOption(const std::string &name, const PageJson &value) {
  RuleOption option;
  option.name = name;
  option.type = value.value("type", "number") == "bool"     ? RuleOption::Type::Flag
                : value.value("type", "number") == "choice" ? RuleOption::Type::Choice
                                                            : RuleOption::Type::Number;
  option.help = value.value("help", "");
  option.min = numberOf(value, "min");
  option.max = numberOf(value, "max");
  option.names = value.value("names", option.names);
  if (option.type == RuleOption::Type::Flag)
    option.fallback = value.value("default", false);
  else if (option.type == RuleOption::Type::Number)
    option.fallback = numberOf(value, "default").value_or(0);
  else
    option.fallback =
        double(llvm::find(option.names, value.value("default", "")) - option.names.begin());
  return option;
}

} // namespace

RulePage readRulePage(const RuleInfo &info) {
  RulePage page;
  llvm::StringRef head;
  std::tie(head, page.body) = splitPage(info.help);
  const PageJson json = PageJson::parse(head.begin(), head.end(), nullptr, false);
  if (!json.is_object())
    return page;
  if (const auto dialects = json.find("dialects"); dialects != json.end() && dialects->is_array())
    for (const PageJson &id : *dialects)
      if (id.is_string())
        page.dialects.push_back(id.get<std::string>());
  if (const auto repeated = json.find("repeated"); repeated != json.end())
    page.repeated = *repeated == "alike"  ? RepeatedFindings::Alike
                    : *repeated == "many" ? RepeatedFindings::Many
                                          : RepeatedFindings::Same;
  if (const auto due = json.find("dueWhere"); due != json.end() && due->is_array())
    for (const PageJson &trait : *due)
      page.dueWhere |= trait == "spindle" ? programsSpindle : programsThreeAxes;
  if (const auto options = json.find("options"); options != json.end() && options->is_object())
    for (const auto &[name, value] : options->items())
      if (value.is_object())
        page.options.push_back(readOption(name, value));
  return page;
}

const RulePage &rulePage(RuleId rule) {
  static std::mutex mutex;
  static std::map<RuleId, RulePage> pages;
  const std::lock_guard<std::mutex> lock(mutex);
  const auto [known, isNew] = pages.try_emplace(rule);
  if (isNew)
    known->second = readRulePage(allRules()[rule].info);
  return known->second;
}

} // namespace ncvet
