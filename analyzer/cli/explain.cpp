// `ncvet explain RULE`: the page of a rule.
#include "analyzer/cli/explain.h"

#include "analyzer/rule/rule_page.h"
#include "analyzer/rule/rule_settings.h"
#include "analyzer/rule/rule_table.h"
#include "analyzer/setup/config.h"
#include "formats/dialect/loader.h"

#include "llvm/Support/FileSystem.h"
#include "llvm/Support/raw_ostream.h"

namespace ncvet::cli {

namespace cl = llvm::cl;

ExplainCommand::ExplainCommand()
    : command_("explain", "show the page of a rule"), category_("Options of ncvet explain"),
      rule_(cl::Positional, cl::desc("RULE"), cl::sub(command_), cl::cat(category_)),
      dialect_(
          "dialect", cl::value_desc("ID"),
          cl::desc("Show the programs of this control only; the nearest .ncvet.json may name it"),
          cl::sub(command_), cl::cat(category_)) {}

namespace {

/// The control that the configuration of this folder names; empty: none.
std::string configuredDialect() {
  llvm::SmallString<128> here;
  if (llvm::sys::fs::current_path(here))
    return "";
  const std::string file = findConfig(here);
  if (file.empty())
    return "";
  auto config = loadConfig(file);
  if (!config) { // whoever checks a program is told of it
    llvm::consumeError(config.takeError());
    return "";
  }
  return config->dialect;
}

} // namespace

int ExplainCommand::run() {
  if (rule_.empty())
    return fail("explain wants the id of a rule; `ncvet rules` lists them");
  const auto entry = llvm::find_if(
      allRules(), [&](const RuleEntry &candidate) { return candidate.info.id == rule_; });
  if (entry == allRules().end()) {
    auto named = rulesNamed(rule_);
    if (!named)
      return fail(llvm::toString(named.takeError()));
    return fail("\"" + llvm::Twine(rule_) + "\" is a category; `ncvet rules` lists its rules");
  }
  const RuleInfo &info = entry->info;
  const RulePage page = readRulePage(info);
  std::string dialect = dialect_;
  if (dialect.empty())
    dialect = configuredDialect();
  else if (llvm::none_of(listDialects(), [&](const auto &known) { return known.id == dialect; }))
    return fail("unknown dialect \"" + llvm::Twine(dialect) + "\"; `ncvet dialects` lists them");
  llvm::raw_ostream &out = llvm::outs();
  // The title first, then what the page's metadata say, then the page.
  llvm::StringRef title, rest;
  std::tie(title, rest) = page.body.split('\n');
  out << title << "\n\n"
      << toString(info.severity) << " · " << info.category << " · "
      << (info.enabledByDefault ? "on" : "off") << " by default · fix: " << info.fix;
  if (!page.dialects.empty())
    out << " · " << llvm::join(page.dialects, ", ");
  const std::string text = dialect.empty() ? rest.str() : withProgramsOf(dialect, rest);
  out << "\n" << text;
  if (!llvm::StringRef(text).endswith("\n"))
    out << '\n';
  out.flush();
  return exitClean;
}

} // namespace ncvet::cli
