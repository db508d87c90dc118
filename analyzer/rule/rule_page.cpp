// A rule's page: the fenced JSON block at its head, and what follows.
#include "analyzer/rule/rule_page.h"

#include <nlohmann/json.hpp>

namespace ncvet {

namespace {

using PageJson = nlohmann::ordered_json;

std::optional<double> numberOf(const PageJson &object, const char *key) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_number())
    return std::nullopt;
  return found->get<double>();
}

} // namespace

RulePage readRulePage(const RuleInfo &info) {
  RulePage page;
  page.body = info.help;
  llvm::StringRef head;
  if (page.body.consume_front("```json\n")) {
    std::tie(head, page.body) = page.body.split("\n```\n");
    page.body = page.body.ltrim("\n");
  }
  const PageJson json = PageJson::parse(head.begin(), head.end(), nullptr, false);
  if (!json.is_object())
    return page;
  if (const auto dialects = json.find("dialects"); dialects != json.end() && dialects->is_array())
    for (const PageJson &id : *dialects)
      if (id.is_string())
        page.dialects.push_back(id.get<std::string>());
  if (const auto repeated = json.find("repeated"); repeated != json.end())
    page.repeated = *repeated == "alike" ? RepeatedFindings::Alike : RepeatedFindings::Same;
  if (const auto options = json.find("options"); options != json.end() && options->is_object())
    for (const auto &[name, value] : options->items()) {
      RuleOption option;
      option.name = name;
      if (value.is_object()) {
        option.fallback = numberOf(value, "default").value_or(0);
        option.min = numberOf(value, "min");
        option.max = numberOf(value, "max");
        if (const auto help = value.find("help"); help != value.end() && help->is_string())
          option.help = help->get<std::string>();
      }
      page.options.push_back(std::move(option));
    }
  return page;
}

std::string withProgramsOf(llvm::StringRef dialect, llvm::StringRef body) {
  const std::string fence = ("```nc " + dialect + " ").str();
  if (!body.contains(fence))
    return body.str();
  std::string kept;
  bool inside = false, drop = false; // a fenced program; of another control
  while (!body.empty()) {
    const size_t end = body.find('\n');
    const llvm::StringRef line = body.take_front(end == llvm::StringRef::npos ? end : end + 1);
    body = body.drop_front(line.size());
    const bool closes = inside && line.startswith("```");
    if (!inside && line.startswith("```nc ")) {
      inside = true;
      drop = !line.startswith(fence);
    }
    if (!drop)
      kept += line;
    else if (closes)
      body.consume_front("\n"); // the empty line behind the program goes with it
    if (closes)
      inside = drop = false;
  }
  return kept;
}

} // namespace ncvet
