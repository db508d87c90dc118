// `ncvet explain RULE`: the page of a rule.
#include "analyzer/cli/explain.h"

#include "analyzer/cli/setup_options.h"
#include "analyzer/rule/rule_page.h"
#include "analyzer/rule/rule_settings.h"
#include "analyzer/rule/rule_table.h"
#include "analyzer/setup/config.h"
#include "formats/finding/page_text.h"
#include "formats/packed/family.h"

#include "llvm/Support/FileSystem.h"
#include "llvm/Support/raw_ostream.h"

namespace ncvet::cli {

ExplainCommand::ExplainCommand() : Command("explain", "show the page of a rule") {
  options.section("Options");
  options
      .add("--dialect", &dialect_,
           "show the programs of this control; the nearest .ncvet.json may name it")
      .valued("ID", "the id of a control, which `ncvet dialects` lists");
  options.add("--all", &all_, "show the programs of all controls");
  options.operands("RULE", rule_, 1, 1);
}

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

/// What is not shown of the page, and how to see it.
void writeOthers(const std::string &rule, llvm::ArrayRef<std::string> controls,
                 llvm::StringRef shown) {
  std::string others;
  for (const std::string &control : controls)
    if (control != shown)
      others += (others.empty() ? "" : ", ") + control;
  if (!others.empty())
    llvm::outs() << "\nThe programs above are for " << shown << ". `ncvet explain " << rule
                 << " --dialect ID` shows those for " << others << "; --all shows all of them.\n";
}

} // namespace

int ExplainCommand::run() {
  const std::string &id = rule_.front();
  const auto entry = llvm::find_if(
      allRules(), [&](const RuleEntry &candidate) { return candidate.info.id == id; });
  if (entry == allRules().end()) {
    auto named = rulesNamed(id);
    if (!named)
      return fail(named.takeError());
    return fail("\"" + id + "\" is a category; `ncvet rules` lists its rules");
  }
  if (!dialect_.empty())
    if (llvm::Error wrong = checkDialect(dialect_))
      return fail(std::move(wrong));
  write(*entry);
  return exitClean;
}

void ExplainCommand::write(const RuleEntry &entry) const {
  const RuleInfo &info = entry.info;
  const RulePage page = readRulePage(info);
  const std::string dialect = dialect_.empty() ? configuredDialect() : dialect_;
  const std::vector<std::string> family = familyOf(dialect);
  const std::vector<std::string> controls = controlsOfPrograms(page.body);
  llvm::raw_ostream &out = llvm::outs();
  // The title first, then what the page's metadata say, then the page.
  llvm::StringRef title, rest;
  std::tie(title, rest) = page.body.split('\n');
  out << title << "\n\n"
      << toString(info.severity) << " · " << info.category << " · "
      << (info.enabledByDefault ? "on" : "off") << " by default · fix: " << info.fix;
  if (!page.dialects.empty())
    out << " · " << llvm::join(page.dialects, ", ");
  out << '\n';
  if (family.size() > 1 && !page.dialects.empty() && firstOf(family, page.dialects).empty())
    out << "\nIt is no rule for " << dialect << ": its page is about other controls.\n";
  // Without a control of the user's, one example says enough.
  std::string shown = firstOf(family, controls);
  if (shown.empty() && !controls.empty())
    shown = controls.front();
  std::string text = rest.str();
  if (!all_ && !shown.empty())
    text = withProgramsOf(std::vector<std::string>{shown}, rest);
  out << llvm::StringRef(forReaders(text)).rtrim('\n') << '\n';
  if (!all_)
    writeOthers(info.id.str(), controls, shown);
}

} // namespace ncvet::cli
