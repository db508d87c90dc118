// `ncvet rules`: the list of rules, for people and as JSON.
#include "analyzer/cli/explain.h"
#include "analyzer/rule/rule.h"
#include "analyzer/rule/rule_page.h"
#include "analyzer/rule/rule_table.h"
#include "formats/text/json_text.h"

#include "llvm/Support/Format.h"
#include "llvm/Support/raw_ostream.h"
#include <nlohmann/json.hpp>

namespace ncvet::cli {

namespace cl = llvm::cl;

namespace {

using Json = nlohmann::ordered_json;

Json describe(const RuleOption &option) {
  Json json = {{"name", option.name}};
  switch (option.type) {
  case RuleOption::Type::Flag:
    json.update({{"type", "bool"}, {"default", option.fallback != 0}});
    break;
  case RuleOption::Type::Number:
    json.update({{"type", "number"}, {"default", option.fallback}});
    break;
  case RuleOption::Type::Choice:
    json.update({{"type", "choice"},
                 {"names", option.names},
                 {"default", option.names[size_t(option.fallback)]}});
    break;
  }
  if (option.min)
    json["min"] = *option.min;
  if (option.max)
    json["max"] = *option.max;
  json["help"] = option.help;
  return json;
}

void writeJson(llvm::raw_ostream &out) {
  out << "{\"version\":1,\"rules\":[";
  llvm::StringRef separator = "\n";
  for (const RuleEntry &entry : allRules()) {
    const RuleInfo &info = entry.info;
    const RulePage page = readRulePage(info);
    Json json = {{"id", info.id.str()},
                 {"category", info.category.str()},
                 {"severity", toString(info.severity).str()},
                 {"default", info.enabledByDefault},
                 {"summary", info.summary.str()},
                 {"fix", info.fix.str()},
                 {"dialects", page.dialects},
                 {"options", Json::array()}};
    for (const RuleOption &option : page.options)
      json["options"].push_back(describe(option));
    out << separator << jsonText(json);
    separator = ",\n";
  }
  out << "\n]}\n";
}

void writeText(llvm::raw_ostream &out) {
  size_t width = 0;
  for (const RuleEntry &entry : allRules())
    width = std::max(width, entry.info.id.size());
  llvm::StringRef category;
  for (const RuleEntry &entry : allRules()) {
    const RuleInfo &info = entry.info;
    if (info.category != category)
      out << (category.empty() ? "" : "\n") << info.category << ":\n";
    category = info.category;
    out << llvm::left_justify(info.id, unsigned(width)) << "  "
        << llvm::left_justify(toString(info.severity), 7) << "  "
        << (info.enabledByDefault ? "   " : "off") << "  " << info.summary << '\n';
  }
}

} // namespace

RulesCommand::RulesCommand()
    : command_("rules", "list the rules"), category_("Options of ncvet rules"),
      format_("format", cl::value_desc("FMT"), cl::init("text"), cl::desc("text (default) or json"),
              cl::sub(command_), cl::cat(category_)) {}

int RulesCommand::run() {
  if (format_ == "json")
    writeJson(llvm::outs());
  else if (format_ == "text")
    writeText(llvm::outs());
  else
    return fail("unknown format \"" + llvm::Twine(format_) + "\"; one of text, json");
  llvm::outs().flush();
  return exitClean;
}

} // namespace ncvet::cli
