// The templates for hosts, run as far as a machine without the host can: pre-commit with a local
// repository, the lines of GitLab and Azure, the lines that GitHub's problem matcher takes.
#include "tests/support/outer_program.h"
#include "tests/support/places.h"
#include "tests/support/process.h"

#include "llvm/Support/Regex.h"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace ncvet::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::string templateText(const std::string &name) {
  return contentsOf(std::filesystem::path(places::sourceFolder()) / name);
}

/// The text after `begin`, up to `end`, on one line.
std::string oneLineOf(const std::string &text, const std::string &begin, const std::string &end) {
  const size_t from = text.find(begin);
  EXPECT_NE(from, std::string::npos) << begin;
  std::string line = text.substr(from + begin.size());
  line = line.substr(0, line.find(end));
  std::replace(line.begin(), line.end(), '\n', ' ');
  return line;
}

void replaceAll(std::string &text, const std::string &what, const std::string &by) {
  for (size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size())
    text.replace(at, what.size(), by);
}

/// Runs a line of a shell in the folder, where `ncvet` is the program; its output is in `log`.
int runLine(const Shop &shop, const std::string &line, const std::string &log) {
  const std::string tools = (shop.path() / "tools").string();
  std::filesystem::create_directories(tools);
  std::error_code error;
  std::filesystem::create_symlink(places::program(), tools + "/ncvet", error);
  return runOuter({"env", "-C", shop.path().string(), "sh", "-c",
                   "PATH='" + tools + "':\"$PATH\"; export PATH; " + line},
                  shop.path() / log, 120);
}

TEST(GitlabTemplate, WritesTheArtifactsThatItNames) {
  Shop shop;
  shop.file("jobs/a.nc", programWithoutFeed());
  const std::string text = templateText("ci/gitlab.yml");
  const std::string line = oneLineOf(text, "script:\n    - ", "\n  artifacts:");
  EXPECT_EQ(1, runLine(shop, "NCVET_PATHS=jobs NCVET_ARGUMENTS='--dialect haas-lathe'; " + line,
                       "gitlab.log"))
      << shop.text("gitlab.log");
  for (const std::string kind : {"codequality: ", "junit: "})
    EXPECT_THAT(shop.text(oneLineOf(text, kind, "\n")), HasSubstr("feed-missing")) << kind;
}

TEST(AzureTemplate, PrintsCommandsAndWritesTheTests) {
  Shop shop;
  shop.file("jobs/a.nc", programWithoutFeed());
  const std::string text = templateText("ci/azure.yml");
  std::string line = oneLineOf(text, "- script: >-\n", "\n    displayName:");
  replaceAll(line, "$(Agent.TempDirectory)", ".");
  replaceAll(line, "${{ parameters.failOn }}", "error");
  replaceAll(line, "${{ parameters.arguments }}", "--dialect haas-lathe");
  replaceAll(line, "${{ parameters.paths }}", "jobs");
  EXPECT_EQ(1, runLine(shop, line, "azure.log")) << shop.text("azure.log");
  EXPECT_THAT(shop.text("azure.log"),
              HasSubstr("##vso[task.logissue type=error;sourcepath=jobs/a.nc;linenumber=4;"));
  std::string tests = oneLineOf(text, "testResultsFiles: ", "\n");
  replaceAll(tests, "$(Agent.TempDirectory)/", "");
  EXPECT_THAT(shop.text(tests), HasSubstr("feed-missing at 4:"));
}

/// A job may name its folder by a variable of the host, which is absolute.
TEST(ReportsForHosts, HavePathsFromTheCurrentFolder) {
  Shop shop;
  shop.file("jobs/a.nc", programWithoutFeed());
  const std::string folder = std::filesystem::canonical(shop.path()).string();
  for (const char *format :
       {"github", "gitlab", "azure", "sonarqube", "rdjsonl", "teamcity", "sarif", "markdown"}) {
    const std::string report =
        shop.run({"check", "--dialect", "haas-lathe", "--format", format, folder + "/jobs"}).out;
    EXPECT_THAT(report, HasSubstr("jobs/a.nc")) << format;
    EXPECT_THAT(report, Not(HasSubstr(folder))) << format;
  }
}

TEST(ReportsForHosts, NameACalledProgramAsOneThatIsChecked) {
  Shop shop;
  shop.file("main.nc", "O0001\nT101\nG97 S800 M03\nM98 P1000\nM30\n");
  shop.file("O1000.nc", "O1000\nG01 X10. Z-5.\nM99\n");
  for (const std::string path : {"./main.nc", ".", "./", "main.nc"})
    EXPECT_THAT(shop.findings({"--dialect", "haas-lathe", "--select", "feed-missing", path}),
                ::testing::ElementsAre("O1000.nc:2 feed-missing"))
        << path;
}

/// What a called program leaves on is told at its caller, however the folder was named.
TEST(ReportsForHosts, FindTheCallerOfAProgramUnderEveryName) {
  Shop shop;
  shop.file("MAIN.MPF", "G54 G17 G90\nT1 D1 M6\nSTEPS\nG0 X0\nM30\n");
  shop.file("STEPS.SPF", "G91\nG0 X5\nM17\n");
  const std::vector<std::string> plain =
      shop.findings({"--dialect", "sinumerik", "MAIN.MPF", "STEPS.SPF"});
  for (const std::string &path :
       std::vector<std::string>{".", "./", "../" + shop.path().filename().string()})
    EXPECT_EQ(shop.findings({"--dialect", "sinumerik", "--relative-to", ".", path}), plain) << path;
}

TEST(ProblemMatcher, TakesTheLinesThatNcvetPrints) {
  Shop shop;
  shop.file("a.nc", programWithoutFeed() + "\n").file("b.nc", "O0001\ng0 x1.\nM30\n");
  const std::string printed =
      shop.run({"check", "--dialect", "haas-lathe", "--profile", "all", "."}).out;
  const auto matchers =
      nlohmann::json::parse(templateText("ci/problem-matcher.json"), nullptr, false);
  ASSERT_TRUE(matchers.is_object());
  std::set<std::string> found;
  for (const auto &matcher : matchers["problemMatcher"]) {
    const auto &pattern = matcher["pattern"][0];
    std::string expression = pattern["regexp"];
    replaceAll(expression, ".+?", ".+"); // what this library does not know
    replaceAll(expression, "(?:, possible)?", "");
    replaceAll(expression, "\\d", "[0-9]");
    llvm::Regex regex(expression);
    llvm::SmallVector<llvm::StringRef, 8> groups;
    for (llvm::StringRef rest = printed; !rest.empty();) {
      llvm::StringRef line;
      std::tie(line, rest) = rest.split('\n');
      if (regex.match(line, &groups))
        found.insert(
            (groups[pattern["file"].get<size_t>()] + " " + groups[pattern["code"].get<size_t>()])
                .str());
    }
  }
  EXPECT_THAT(found, ::testing::IsSupersetOf({"a.nc feed-missing", "b.nc style-lower-case"}));
}

TEST(Action, SaysThatTheProgramIsMissing) {
  Shop shop;
  const auto log = shop.path() / "action.log";
  EXPECT_EQ(2, runOuter({"env", "NCVET=no-such-ncvet", "INPUT_PATHS=.", "INPUT_ARGUMENTS=",
                         "INPUT_FAIL_ON=", "INPUT_CHANGED_SINCE=", "INPUT_BASELINE=",
                         "INPUT_SARIF=", places::sourceFolder() + "/ci/github.sh"},
                        log, 60));
  EXPECT_THAT(shop.text("action.log"), HasSubstr("::error title=ncvet::no-such-ncvet is not in"));
}

/// With the hooks of this project in a repository of their own.
TEST(PreCommit, ChecksAndFixesThePrograms) {
  if (!llvm::sys::findProgramByName("pre-commit") || !llvm::sys::findProgramByName("git"))
    GTEST_SKIP() << "pre-commit is not installed: ./dev packages reports";
  Shop shop;
  shop.file("hooks/.pre-commit-hooks.yaml", templateText(".pre-commit-hooks.yaml"));
  shop.file("work/.ncvet.json", R"({"dialect": "haas-lathe", "extendSelect": ["style-lower-case"],
                                    "exclude": ["old/"]})");
  shop.file("work/a.nc", "O0001\ng0 x1.\nM30\n").file("work/notes.txt", "x1.\n");
  shop.file("work/old/O1", "g0 x1.\n");
  const std::string commit = "git init -q . && git add -A && git -c user.name=a -c user.email=a@b "
                             "-c commit.gpgsign=false commit -qm 1";
  const std::string line =
      "export HOME=\"$PWD\" PRE_COMMIT_HOME=\"$PWD/home\"; (cd hooks && " + commit +
      ") && cd work && printf 'repos:\\n- repo: ../hooks\\n  rev: %s\\n  hooks: [{id: ncvet}, "
      "{id: ncvet-fix}]\\n' \"$(git -C ../hooks rev-parse HEAD)\" > .pre-commit-config.yaml && " +
      commit + " && pre-commit run --all-files";
  EXPECT_EQ(1, runLine(shop, line, "hooks.log")) << "a hook has changed a file";
  EXPECT_THAT(shop.text("hooks.log"), HasSubstr("files were modified by this hook"));
  EXPECT_EQ(shop.text("work/a.nc"), "O0001\nG0 X1.\nM30\n");
  EXPECT_EQ(shop.text("work/old/O1"), "g0 x1.\n");
}

} // namespace
} // namespace ncvet::test
