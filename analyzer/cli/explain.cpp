// `ncvet explain RULE`: the page of a rule.
#include "analyzer/cli/explain.h"

#include "analyzer/rule_page.h"
#include "analyzer/rule_settings.h"

#include "llvm/Support/raw_ostream.h"

namespace ncvet::cli {

namespace cl = llvm::cl;

ExplainCommand::ExplainCommand()
    : command_("explain", "show the page of a rule"), category_("Options of ncvet explain"),
      rule_(cl::Positional, cl::desc("RULE"), cl::sub(command_), cl::cat(category_)) {}

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
  llvm::raw_ostream &out = llvm::outs();
  // The title first, then what the page's metadata say, then the page.
  llvm::StringRef title, rest;
  std::tie(title, rest) = page.body.split('\n');
  out << title << "\n\n"
      << toString(info.severity) << " · " << info.category << " · "
      << (info.enabledByDefault ? "on" : "off") << " by default · fix: " << info.fix;
  if (!page.dialects.empty())
    out << " · " << llvm::join(page.dialects, ", ");
  out << "\n" << rest;
  if (!rest.endswith("\n"))
    out << '\n';
  out.flush();
  return exitClean;
}

} // namespace ncvet::cli
