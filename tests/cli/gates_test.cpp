// The ways into ncvet from outside: hooks, the action, completions, the manual page; `config` and
// `init`.
#include "analyzer/setup/detect.h"
#include "tests/support/outer_program.h"
#include "tests/support/places.h"
#include "tests/support/process.h"

#include "llvm/Support/Regex.h"
#include <gmock/gmock.h>

#include <set>

namespace ncvet::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

std::string sourceText(const std::string &name) {
  auto buffer = llvm::MemoryBuffer::getFile(places::sourceFolder() + "/" + name);
  return buffer ? (*buffer)->getBuffer().str() : std::string();
}

/// The long options that the help of a command lists.
std::set<std::string> optionsOf(const Shop &shop, const std::string &command) {
  std::set<std::string> options;
  const std::string help = shop.run({command, "--help"}).out;
  for (llvm::StringRef rest = help; !rest.empty();) {
    llvm::StringRef line;
    std::tie(line, rest) = rest.split('\n');
    if (!line.consume_front("  ") || !line.startswith("-"))
      continue;
    if (!line.startswith("--"))
      line = line.split(", ").second;
    options.insert(line.take_until([](char c) { return c == ' ' || c == '['; }).str());
  }
  return options;
}

TEST(ManualPage, NamesEveryOptionAndEveryFormat) {
  Shop shop;
  std::string page = sourceText("analyzer/cli/ncvet.1");
  for (size_t at; (at = page.find("\\-")) != std::string::npos;)
    page.replace(at, 2, "-");
  for (const char *command :
       {"check", "trace", "explain", "config", "init", "merge", "rules", "dialects"})
    for (const std::string &option : optionsOf(shop, command))
      if (option != "--check") { // of tables: for those who write them
        EXPECT_THAT(page, HasSubstr(option)) << command;
      }
  EXPECT_GE(optionsOf(shop, "check").size(), 30u);
  const std::string help = shop.run({"check", "--help"}).out;
  for (const char *format : {"github", "gitlab", "sonarqube", "markdown"}) {
    EXPECT_THAT(help, HasSubstr(format));
    EXPECT_THAT(page, HasSubstr(format));
    EXPECT_THAT(sourceText("docs/reports.md"), HasSubstr("| `" + std::string(format) + "` |"));
  }
}

/// Words that bash offers after these.
std::vector<std::string> completed(const Shop &shop, const std::string &line) {
  const std::string script =
      "source /usr/share/bash-completion/bash_completion 2>/dev/null\n"
      "source '" +
      places::sourceFolder() +
      "/analyzer/cli/completion/ncvet.bash'\n"
      "ncvet() { '" +
      places::program() +
      "' \"$@\"; }\n"
      "COMP_LINE='" +
      line +
      "'; COMP_POINT=${#COMP_LINE}; COMP_WORDS=($COMP_LINE)\n"
      "[[ $COMP_LINE == *' ' ]] && COMP_WORDS+=('')\n"
      "COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); COMP_TYPE=9; _ncvet 2>/dev/null\n"
      "printf '%s\\n' \"${COMPREPLY[@]}\"\n";
  const auto log = shop.path() / "completion.log";
  const auto file = shop.path() / "completion.bash";
  std::ofstream(file) << script;
  runOuter({"bash", file.string()}, log, 30);
  std::vector<std::string> words;
  std::ifstream in(log);
  for (std::string word; std::getline(in, word);)
    words.push_back(word);
  return words;
}

TEST(Completion, OffersWhatTheCommandTakesAndNothingElse) {
  if (!std::filesystem::exists("/usr/share/bash-completion/bash_completion"))
    GTEST_SKIP() << "no bash-completion";
  Shop shop;
  EXPECT_THAT(completed(shop, "ncvet check --changed-"),
              ::testing::UnorderedElementsAre("--changed-since", "--changed-lines"));
  EXPECT_THAT(completed(shop, "ncvet rules --format "),
              ::testing::UnorderedElementsAre("text", "json", "markdown"));
  EXPECT_THAT(completed(shop, "ncvet check --format git"),
              ::testing::UnorderedElementsAre("github", "gitlab"));
  EXPECT_THAT(completed(shop, "ncvet explain feed-miss"),
              ::testing::UnorderedElementsAre("feed-missing"));
}

TEST(Hooks, TakeTheEndingsOfPrograms) {
  const std::string hooks = sourceText(".pre-commit-hooks.yaml");
  const size_t begin = hooks.find("files: (?i)") + 11;
  const std::string pattern = hooks.substr(begin, hooks.find('\n', begin) - begin);
  llvm::Regex regex(pattern, llvm::Regex::IgnoreCase);
  for (const std::string &ending : Detector::builtinEndings().sure)
    EXPECT_TRUE(regex.match("jobs/part." + ending)) << ending;
  EXPECT_TRUE(regex.match("jobs/O1234"));
  EXPECT_FALSE(regex.match("jobs/notes.md"));
}

TEST(Action, GivesItsInputsToNcvet) {
  Shop shop;
  shop.file("jobs/a.nc", programWithoutFeed());
  const auto log = shop.path() / "action.log";
  const auto summary = shop.path() / "summary.md", sarif = shop.path() / "out.sarif";
  const int code = runOuter(
      {"env", "-C", shop.path().string(), "NCVET=" + places::program(), "INPUT_PATHS=jobs",
       "INPUT_ARGUMENTS=--dialect haas-lathe --select feed-missing", "INPUT_FAIL_ON=warning",
       "INPUT_CHANGED_SINCE=", "INPUT_BASELINE=", "INPUT_SARIF=" + sarif.string(),
       "GITHUB_STEP_SUMMARY=" + summary.string(), places::sourceFolder() + "/ci/github.sh"},
      log, 60);
  EXPECT_EQ(1, code);
  EXPECT_THAT(shop.text("action.log"),
              HasSubstr("::error title=ncvet%3A feed-missing,file=jobs/a.nc,line=4,"));
  EXPECT_THAT(shop.text("summary.md"),
              HasSubstr("### ncvet: 1 finding: 1 error, 0 warnings, 0 style"));
  EXPECT_THAT(shop.text("out.sarif"), HasSubstr("\"2.1.0\""));
  // All inputs of the script are those of the action.
  for (const char *input :
       {"paths", "arguments", "fail-on", "changed-since", "baseline", "sarif", "ncvet"})
    EXPECT_THAT(sourceText("action.yml"), HasSubstr("${{ inputs." + std::string(input) + " }}"));
}

TEST(ConfigCommand, SaysWhatCountsAndWhoSaidSo) {
  Shop shop;
  shop.file("cell/a.nc", programWithoutFeed());
  shop.file("shop.json", R"({"failOn": "warning", "select": ["feed"]})");
  shop.file("cell/.ncvet.json", R"({"extends": "../shop.json", "dialect": "haas-lathe"})");
  const ProcessResult text = shop.run({"config", "cell/a.nc"});
  EXPECT_EQ(0, text.exitCode) << text.err;
  EXPECT_THAT(text.out, HasSubstr("dialect         haas-lathe  (cell/.ncvet.json)\n"));
  EXPECT_THAT(text.out, HasSubstr("failOn          warning  (cell/../shop.json)\n"));
  EXPECT_THAT(text.out, HasSubstr("machine         none  (default)\n"));
  const auto json = nlohmann::json::parse(shop.run({"config", "--format", "json", "cell/a.nc"}).out,
                                          nullptr, false);
  ASSERT_TRUE(json.is_object());
  EXPECT_EQ(json["settings"]["select"]["value"], nlohmann::json({"feed"}));
  EXPECT_EQ(json["rules"]["feed-missing"], "error");
  EXPECT_FALSE(json["rules"].contains("style-lower-case"));
  EXPECT_THAT(shop.run({"config", "--dialect", "ecs"}).out, HasSubstr("ecs  (--dialect)"));
}

TEST(InitCommand, WritesAConfigurationForTheControlOfTheFolder) {
  Shop shop;
  shop.file("a.mpf", "%_N_SHAFT_MPF\nG54 G17 G90\nT1 D1 M6\nTRANS X10\nM30\n");
  const ProcessResult result = shop.run({"init"});
  EXPECT_EQ(0, result.exitCode) << result.err;
  EXPECT_THAT(result.out, StartsWith("wrote .ncvet.json: sinumerik"));
  EXPECT_EQ(nlohmann::json::parse(shop.text(".ncvet.json"), nullptr, false)["dialect"],
            "sinumerik");
  EXPECT_NE(2, shop.run({"check"}).exitCode);
  EXPECT_THAT(shop.run({"init"}).err, HasSubstr(".ncvet.json is there already; --force"));
  EXPECT_EQ(
      0, shop.run({"init", "--force", "--dialect", "haas-mill", "--profile", "strict"}).exitCode);
  EXPECT_THAT(shop.text(".ncvet.json"), HasSubstr("\"extends\": \"strict\""));
  EXPECT_EQ(2, shop.run({"init", "--force", "--dialect", "haas-mil"}).exitCode);
}

TEST(RulesCommand, IsATableInMarkdown) {
  Shop shop;
  EXPECT_THAT(shop.run({"rules", "--format", "markdown"}).out,
              HasSubstr("| `feed-missing` | error | on | "));
}

/// The published schema, by a validator that others use.
TEST(ReportSchema, DescribesTheJsonReport) {
  Shop shop;
  shop.file("a.nc", programWithoutFeed()).file("b.nc", "o0001\ng00 x10.\nm30\n");
  const std::vector<std::string> arguments = {"check", "--dialect", "haas-lathe", "--profile",
                                              "all",   "--format",  "json"};
  const auto reported = [&](std::vector<std::string> more, const std::string &file) {
    more.insert(more.begin(), arguments.begin(), arguments.end());
    more.insert(more.end(), {"-o", file});
    shop.run(more);
  };
  shop.run({"check", "--dialect", "haas-lathe", "--write-baseline", "known.json"});
  reported({"none.nc", "."}, "all.json");
  shop.file("a.nc", "O0001\nM30\n");
  reported({"--baseline", "known.json"}, "absent.json");
  EXPECT_THAT(shop.text("absent.json"), Not(HasSubstr("\"absent\":[\n]")));
  const std::string script = "import json, sys\n"
                             "try:\n"
                             "    import jsonschema\n"
                             "except ImportError:\n"
                             "    sys.exit(77)\n"
                             "schema = json.load(open(sys.argv[1]))\n"
                             "jsonschema.Draft202012Validator.check_schema(schema)\n"
                             "for name in sys.argv[2:]:\n"
                             "    jsonschema.validate(json.load(open(name)), schema)\n";
  shop.file("validate.py", script);
  const int code =
      runOuter({"/usr/bin/python3", (shop.path() / "validate.py").string(),
                places::sourceFolder() + "/rulesets/schema/report.schema.json",
                (shop.path() / "all.json").string(), (shop.path() / "absent.json").string()},
               shop.path() / "validate.log", 60);
  if (code == 77 || code == -1)
    GTEST_SKIP() << "no python3-jsonschema";
  EXPECT_EQ(0, code) << shop.text("validate.log");
}

/// Reports in XML, by a parser of their consumers.
TEST(JunitReport, IsReadByJunitparser) {
  Shop shop;
  shop.file("a.nc", programWithoutFeed()).file("\xC3\xB6&<b>.nc", programWithoutFeed());
  shop.file("clean.nc", "O0001\nM30\n");
  shop.run({"check", "--dialect", "haas-lathe", "--select", "feed-missing", "--report",
            "junit:out.xml", "--report", "checkstyle:style.xml"});
  shop.file("read.py", "import sys\n"
                       "import xml.etree.ElementTree as tree\n"
                       "try:\n"
                       "    import junitparser\n"
                       "except ImportError:\n"
                       "    sys.exit(77)\n"
                       "xml = junitparser.JUnitXml.fromfile(sys.argv[1])\n"
                       "cases = [case for suite in xml for case in suite]\n"
                       "failed = [case for case in cases if case.result]\n"
                       "tree.parse(sys.argv[2])\n"
                       "print(xml.tests, xml.failures, len(cases), len(failed))\n");
  const int code =
      runOuter({"/usr/bin/python3", (shop.path() / "read.py").string(),
                (shop.path() / "out.xml").string(), (shop.path() / "style.xml").string()},
               shop.path() / "read.log", 60);
  if (code == 77 || code == -1)
    GTEST_SKIP() << "no python3-junitparser";
  EXPECT_EQ("3 2 3 2\n", shop.text("read.log"));
}

} // namespace
} // namespace ncvet::test
