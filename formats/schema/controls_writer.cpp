// What is known of each control, from which source, and what is not: made of the tables.
#include "formats/schema/controls_writer.h"

#include "formats/dialect/loader.h"
#include "formats/text/formatted.h"

#include <map>

namespace ncvet {

namespace {

constexpr llvm::StringLiteral introduction =
    "# The controls\n\n"
    "What ncvet knows of each control, from which source, and what it does not know. This page is\n"
    "made of the tables in `rulesets/dialects` by `./dev schema`.\n\n"
    "*Codes that are only named* are known to exist: they are no mistake, and their effect on the\n"
    "machine is not followed. After *codes of unknown effect* positions, the spindle or "
    "everything\n"
    "counts as unknown, and rules that need it are silent.\n";

/// Names in lines of a readable length.
std::string listOf(const std::vector<std::string> &names) {
  constexpr size_t lineLength = 100;
  std::string text, line;
  for (const std::string &name : names) {
    if (line.size() + name.size() + 3 > lineLength) {
      text += line + "\n";
      line.clear();
    }
    line += (line.empty() ? "`" : " `") + name + "`";
  }
  return text + line + "\n";
}

/// Codes by what is known of them.
struct KnownCodes {
  std::map<std::string, unsigned> bySource;
  std::vector<std::string> named, unknown;
  unsigned all = 0;

  void add(const CodeInfo &code) {
    ++all;
    // `operator's manual, L560`: the book is what comes before the lines; `1014-1020`: lines alone.
    const llvm::StringRef book = llvm::StringRef(code.source).split(", L").first;
    const bool lines = !book.empty() && book[0] >= '0' && book[0] <= '9';
    ++bySource[book.empty() ? "no source" : lines ? "lines of its manual" : book.str()];
    if (code.action == Action::MachineSpecific || code.elsewhere || !code.losesPlace.empty())
      unknown.push_back(code.name);
    else if (code.action == Action::None && code.notices.empty() && code.variants.empty())
      named.push_back(code.name);
  }
};

std::string sectionOf(const Dialect &dialect, const DialectSummary &summary) {
  KnownCodes codes;
  for (size_t i = 0; i < dialect.codes.size(); ++i)
    if (dialect.codes[i].base == CodeIndex(i))
      codes.add(dialect.codes[i]);
  std::string text = formatted("\n## {0}\n\n`{1}`, for a {2}", dialect.title, dialect.id,
                               dialect.isLathe() ? "lathe" : "mill");
  if (!summary.extends.empty())
    text += ", laid over `" + summary.extends + "`";
  text += formatted(". {0} codes.\n\n| source | codes |\n|---|---|\n", codes.all);
  for (const auto &[source, count] : codes.bySource)
    text += formatted("| {0} | {1} |\n", source, count);
  if (!codes.named.empty())
    text += "\nCodes that are only named:\n\n" + listOf(codes.named);
  if (!codes.unknown.empty())
    text += "\nCodes of unknown effect:\n\n" + listOf(codes.unknown);
  std::map<std::string, std::string> options;
  for (const auto &option : dialect.options)
    options[option.getKey().str()] = option.second;
  if (!options.empty())
    text +=
        "\nWhat the machine profile may say, with what holds otherwise:\n\n| option | without it "
        "|\n|---|---|\n";
  for (const auto &[name, value] : options)
    text += formatted("| `{0}` | {1} |\n", name, value.empty() ? "not known" : value);
  return text;
}

} // namespace

std::string controlsText() {
  std::string text(introduction);
  for (const DialectSummary &summary : listDialects()) {
    if (summary.abstract)
      continue;
    auto dialect = loadDialect(summary.id, builtinDialects());
    if (dialect)
      text += sectionOf(**dialect, summary);
    else
      llvm::consumeError(dialect.takeError());
  }
  return text;
}

} // namespace ncvet
