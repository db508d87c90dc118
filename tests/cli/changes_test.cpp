// Parts of a check: what a change concerns, shards and their merged report.
#include "tests/support/outer_program.h"
#include "tests/support/process.h"

#include <gmock/gmock.h>

namespace ncvet::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

std::vector<std::string> feedsAnd(std::vector<std::string> more) {
  std::vector<std::string> arguments = {"--dialect", "haas-lathe", "--select", "feed-missing"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

std::vector<std::string> checked(std::vector<std::string> more) {
  std::vector<std::string> arguments = feedsAnd(std::move(more));
  arguments.insert(arguments.begin(), "check");
  return arguments;
}

TEST(ChangedLines, OfAPatchDecideWhatIsTold) {
  Shop shop;
  shop.file("a.nc", programWithoutFeed()).file("b.nc", programWithoutFeed());
  const std::string cut = "--- a/a.nc\n+++ b/a.nc\n@@ -4 +4 @@\n-G01 X10. Z-5.\n+G01 X20. Z-5.\n";
  shop.file("cut.patch", cut);
  EXPECT_THAT(shop.findings(feedsAnd({"--changed-lines", "cut.patch"})),
              ElementsAre("a.nc:4 feed-missing"));
  // A line of the text that looks like the head of a file is none.
  shop.file("other.patch", "--- a/b.nc\n+++ b/b.nc\n@@ -1,2 +1,3 @@\n O0001 (SHAFT)\n"
                           "+++ b/a.nc\n T101\n@@ -6 +7 @@\n-M02\n+M30\n");
  EXPECT_THAT(shop.findings(feedsAnd({"--changed-lines", "other.patch"})), IsEmpty());
  EXPECT_EQ(0, shop.run(checked({"--changed-lines", "other.patch"})).exitCode);
  EXPECT_THAT(shop.run(checked({"--changed-lines", "-"}), cut).out, HasSubstr("a.nc:4:"));
}

TEST(ChangedLines, TellWhatAChangedCallBreaksElsewhere) {
  Shop shop;
  shop.file("main.nc", "O0001\nT101\nG97 S800 M03\nM98 P1000\nM30\n");
  shop.file("O1000.nc", "O1000\nG01 X10. Z-5.\nM99\n");
  shop.file("call.patch", "--- a/main.nc\n+++ b/main.nc\n@@ -3,0 +4 @@\n+M98 P1000\n");
  EXPECT_THAT(shop.findings(feedsAnd({"--changed-lines", "call.patch", "main.nc"})),
              ElementsAre("O1000.nc:2 feed-missing"));
}

TEST(ChangedLines, OfWhatIsNoPatchAreAnErrorInOneLine) {
  Shop shop;
  shop.file("a.nc", programWithoutFeed()).file("bad.patch", "+++ b/a.nc\n@@ -x +y @@\n");
  for (const auto &[file, said] :
       {std::pair("a.nc", "--changed-lines a.nc: it is no unified diff"),
        std::pair("bad.patch", "line 2 of the patch is no head of a hunk"),
        std::pair("none.patch", "cannot read none.patch")}) {
    const ProcessResult result = shop.run(checked({"--changed-lines", file, "a.nc"}));
    EXPECT_EQ(2, result.exitCode);
    EXPECT_THAT(result.err, HasSubstr(said));
    EXPECT_EQ("", result.out);
  }
}

class ChangedSince : public ::testing::Test {
protected:
  void SetUp() override {
    if (!llvm::sys::findProgramByName("git"))
      GTEST_SKIP() << "no git";
    git({"init", "-q", "."});
  }

  void git(std::vector<std::string> arguments) const {
    std::vector<std::string> words = {"git",
                                      "-C",
                                      shop.path().string(),
                                      "-c",
                                      "user.name=Shop",
                                      "-c",
                                      "user.email=shop@example.com"};
    words.insert(words.end(), arguments.begin(), arguments.end());
    ASSERT_EQ(0, runOuter(words, shop.path() / "git.log", 60));
  }

  Shop shop;
};

TEST_F(ChangedSince, ACommitTellsOfWhatIsNewOnly) {
  shop.file("sub/a.nc", programWithoutFeed()).file("sub/\xC3\xB6 b.nc", programWithoutFeed());
  git({"add", "."});
  git({"commit", "-q", "-m", "programs"});
  EXPECT_THAT(shop.findings(feedsAnd({"--changed-since", "HEAD"})), IsEmpty());
  std::string cut = programWithoutFeed();
  cut.replace(cut.find("X20."), 4, "X30.");
  shop.file("sub/\xC3\xB6 b.nc", cut).file("sub/new.nc", programWithoutFeed());
  EXPECT_THAT(shop.findings(feedsAnd({"--changed-since", "HEAD"})),
              ElementsAre("sub/new.nc:4 feed-missing", "sub/\xC3\xB6 b.nc:4 feed-missing"));
  const ProcessResult unknown = shop.run(checked({"--changed-since", "no-such-commit"}));
  EXPECT_EQ(2, unknown.exitCode);
  EXPECT_THAT(unknown.err, HasSubstr("--changed-since: fatal: "));
  const ProcessResult option = shop.run(checked({"--changed-since=--output=x", "sub"}));
  EXPECT_THAT(option.err, HasSubstr("--changed-since wants a commit"));
}

TEST(Shards, TogetherAreTheWholeReport) {
  Shop shop;
  for (int i = 0; i < 9; ++i)
    shop.file("part" + std::to_string(i) + ".nc", programWithoutFeed());
  shop.file("main.nc", "O0001\nT101\nG97 S800 M03\nM98 P1000\nM30\n");
  shop.file("main2.nc", "O0002\nT101\nG97 S800 M03\nM98 P1000\nM30\n");
  shop.file("O1000.nc", "O1000\nG01 X10. Z-5.\nM99\n");
  for (const char *format : {"json", "sarif"}) {
    std::vector<std::string> merge = {"merge"};
    for (const char *shard : {"1/3", "2/3", "3/3"}) {
      const std::string file = std::string(format) + shard[0];
      shop.run(checked({"--shard", shard, "--format", format, "-o", file}));
      merge.push_back(file);
    }
    const ProcessResult merged = shop.run(merge);
    EXPECT_EQ(0, merged.exitCode) << merged.err;
    const auto whole =
        nlohmann::json::parse(shop.run(checked({"--format", format})).out, nullptr, false);
    const auto joined = nlohmann::json::parse(merged.out, nullptr, false);
    ASSERT_TRUE(joined.is_object()) << merged.out;
    if (std::string(format) == "json") {
      EXPECT_EQ(whole["findings"].size(), joined["findings"].size());
      EXPECT_EQ(whole["files"], joined["files"]);
      EXPECT_EQ(whole["summary"], joined["summary"]);
    } else {
      const auto &run = joined["runs"][0];
      EXPECT_EQ(whole["runs"][0]["results"].size(), run["results"].size());
      EXPECT_EQ(whole["runs"][0]["artifacts"].size(), run["artifacts"].size());
      for (const auto &result : run["results"]) {
        const auto &location = result["locations"][0]["physicalLocation"]["artifactLocation"];
        EXPECT_EQ(location["uri"],
                  run["artifacts"][location["index"].get<size_t>()]["location"]["uri"]);
        EXPECT_EQ(result["ruleId"],
                  run["tool"]["driver"]["rules"][result["ruleIndex"].get<size_t>()]["id"]);
      }
    }
  }
}

TEST(Merge, RefusesWhatIsNoReport) {
  Shop shop;
  shop.file("a.json", "{\"version\": 2}").file("b.json", "[").file("c.json", "[1]");
  shop.file("d.sarif", "{\"runs\": []}");
  EXPECT_THAT(shop.run({"merge", "a.json"}).err, HasSubstr("a.json: it is no report of version 1"));
  EXPECT_THAT(shop.run({"merge", "b.json"}).err, HasSubstr("b.json:1: "));
  EXPECT_EQ(2, shop.run({"merge", "c.json"}).exitCode);
  EXPECT_THAT(shop.run({"merge", "d.sarif"}).err, HasSubstr("with one run is expected"));
  EXPECT_EQ(2, shop.run({"merge"}).exitCode);
  EXPECT_EQ(2, shop.run({"merge", "none.json"}).exitCode);
}

TEST(RelativeTo, AnotherFolderChangesHowPathsAreShownAndNothingElse) {
  Shop shop;
  shop.file("cell/mill/a.nc", programWithoutFeed());
  shop.file("cell/.ncvet.json", R"({"dialect": "haas-lathe", "select": ["feed-missing"]})");
  EXPECT_THAT(shop.findings({"--relative-to", "cell", "cell/mill"}),
              ElementsAre("mill/a.nc:4 feed-missing"));
  EXPECT_EQ(1, shop.run({"check", "--relative-to", "cell", "-o", "out.txt", "cell"}).exitCode);
  EXPECT_THAT(shop.text("out.txt"), HasSubstr("mill/a.nc:4:"));
}

} // namespace
} // namespace ncvet::test
