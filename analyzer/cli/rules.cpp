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

void writeMarkdown(llvm::raw_ostream &out) {
  llvm::StringRef category;
  for (const RuleEntry &entry : allRules()) {
    const RuleInfo &info = entry.info;
    if (info.category != category)
      out << (category.empty() ? "" : "\n") << "## " << info.category
          << "\n\n| rule | severity | default | fix | what it reports |\n|---|---|---|---|---|\n";
    category = info.category;
    out << "| `" << info.id << "` | " << toString(info.severity) << " | "
        << (info.enabledByDefault ? "on" : "off") << " | " << info.fix << " | ";
    for (const char byte : info.summary)
      byte == '|' ? out << "\\|" : out << byte;
    out << " |\n";
  }
}

} // namespace

RulesCommand::RulesCommand() : Command("rules", "list the rules") {
  options.section("Options");
  options.add("--format", &format_, "text (default), json, markdown")
      .valued("FMT")
      .among({"text", "json", "markdown"});
}

int RulesCommand::run() {
  if (format_ == "json")
    writeJson(llvm::outs());
  else if (format_ == "markdown")
    writeMarkdown(llvm::outs());
  else
    writeText(llvm::outs());
  return exitClean;
}

} // namespace ncvet::cli
