// What `ncvet check` takes as a program: links, files named twice, texts that no control reads.
#include "tests/support/process.h"

#include <gmock/gmock.h>

namespace ncvet::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

const std::vector<std::string> missingFeeds = {"--dialect", "haas-lathe", "--select",
                                               "feed-missing"};

std::vector<std::string> joined(std::vector<std::string> arguments,
                                const std::vector<std::string> &more) {
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

TEST(Links, ThatLeadOutOfTheFolderAreNotFollowed) {
  Shop shop;
  shop.file("outside/a.nc", programWithoutFeed()).file("jobs/b.nc", programWithoutFeed());
  std::filesystem::create_symlink("../outside/a.nc", shop.path() / "jobs/a.nc");
  std::filesystem::create_directory_symlink("../outside", shop.path() / "jobs/more");
  std::filesystem::create_symlink("b.nc", shop.path() / "jobs/c.nc");
  EXPECT_THAT(shop.findings(joined(missingFeeds, {"jobs"})),
              ElementsAre("jobs/b.nc:4 feed-missing"));
  EXPECT_THAT(shop.run(joined({"check", "jobs"}, missingFeeds)).err,
              HasSubstr("2 links lead out of jobs and are left out; --follow-links follows them"));
  EXPECT_THAT(shop.findings(joined(missingFeeds, {"--follow-links", "jobs"})),
              ElementsAre("jobs/b.nc:4 feed-missing", "jobs/more/a.nc:4 feed-missing"));
}

TEST(Links, AreWrittenThroughOnlyWhenAsked) {
  Shop shop;
  const std::string lower = "O0001\ng00 x10.\nM30\n";
  shop.file("outside/a.nc", lower).file("jobs/readme.md", "");
  std::filesystem::create_symlink("../outside/a.nc", shop.path() / "jobs/a.nc");
  const std::vector<std::string> fix = {"check",    "--dialect",        "haas-lathe",
                                        "--select", "style-lower-case", "--fix"};
  const ProcessResult refused = shop.run(joined(fix, {"jobs/a.nc"}));
  EXPECT_EQ(2, refused.exitCode);
  EXPECT_THAT(refused.err, HasSubstr("jobs/a.nc is not written: it is a link out of its folder"));
  EXPECT_EQ(lower, shop.text("outside/a.nc"));
  EXPECT_EQ(0, shop.run(joined(fix, {"--follow-links", "jobs/a.nc"})).exitCode);
  EXPECT_EQ("O0001\nG00 X10.\nM30\n", shop.text("outside/a.nc"));
  EXPECT_TRUE(std::filesystem::is_symlink(shop.path() / "jobs/a.nc"));
}

TEST(Inputs, AFileThatIsNamedInThreeWaysIsCheckedOnce) {
  Shop shop;
  shop.file("sub/a.nc", programWithoutFeed());
  EXPECT_THAT(shop.findings(joined(missingFeeds, {"./sub/a.nc", "sub/../sub/a.nc", "sub/a.nc",
                                                  (shop.path() / "sub/a.nc").string(), "sub"})),
              ElementsAre("sub/a.nc:4 feed-missing"));
}

TEST(Inputs, AFolderWithoutProgramsSaysSo) {
  Shop shop;
  shop.file("docs/notes.md", "Nothing to turn here.\n");
  const ProcessResult result = shop.run({"check", "docs"});
  EXPECT_EQ(0, result.exitCode);
  EXPECT_EQ(
      "ncvet: warning: no programs in docs; \"files\" in .ncvet.json adds patterns of names\n",
      result.err);
}

TEST(Inputs, TextInUtf16IsAFailureThatSaysWhatToDo) {
  Shop shop;
  std::string little, big;
  for (const char c : programWithoutFeed()) {
    little += {c, '\0'};
    big += {'\0', c};
  }
  shop.file("marked.nc", "\xFF\xFE" + little).file("little.nc", little).file("big.nc", big);
  for (const char *name : {"marked.nc", "little.nc", "big.nc", "."}) {
    const ProcessResult result = shop.run({"check", name});
    EXPECT_EQ(2, result.exitCode) << name;
    EXPECT_THAT(result.err, HasSubstr("it is UTF-16 text, which no control reads; save it as"));
    EXPECT_EQ("", result.out);
  }
}

TEST(Inputs, ABinaryFileIsNoProgramWhateverItsName) {
  Shop shop;
  std::string binary = "\x7F"
                       "ELF";
  for (int i = 0; i < 2000; ++i)
    binary += char(i * 37 % 251);
  shop.file("jobs/a.nc", binary).file("jobs/b.nc", programWithoutFeed());
  EXPECT_EQ(2, shop.run({"check", "jobs/a.nc"}).exitCode);
  // In a folder it is left out, and that is said.
  const ProcessResult folder = shop.run(joined({"check", "jobs"}, missingFeeds));
  EXPECT_EQ(1, folder.exitCode);
  EXPECT_THAT(folder.err,
              HasSubstr("ncvet: warning: jobs/a.nc: not checked: it is a binary file, no program"));
}

TEST(Inputs, APunchedTapeIsText) {
  Shop shop;
  const std::string leader(200, '\0');
  shop.file("tape.nc", leader + "%\r\n" + programWithoutFeed() + "%\r\n\x13" + leader);
  EXPECT_NE(2, shop.run(joined({"check", "tape.nc"}, missingFeeds)).exitCode);
}

TEST(Inputs, WhatIsExcludedIsLeftOutOfFoldersAndWithForceEverywhere) {
  Shop shop;
  shop.file("a.nc", programWithoutFeed()).file("old/b.nc", programWithoutFeed());
  EXPECT_THAT(shop.findings(joined(missingFeeds, {"--exclude", "old/, *.bak"})),
              ElementsAre("a.nc:4 feed-missing"));
  EXPECT_THAT(shop.findings(joined(missingFeeds, {"--exclude", "old/", "old/b.nc"})),
              ElementsAre("old/b.nc:4 feed-missing"));
  EXPECT_THAT(
      shop.findings(joined(missingFeeds, {"--exclude", "old/", "--force-exclude", "old/b.nc"})),
      IsEmpty());
  shop.file(".ncvet.json", R"({"exclude": ["a.nc"]})");
  EXPECT_THAT(shop.findings(joined(missingFeeds, {"--force-exclude", "a.nc", "old/b.nc"})),
              ElementsAre("old/b.nc:4 feed-missing"));
}

TEST(ConfigurationFiles, MayHaveCommentsAndNoKeyTwice) {
  Shop shop;
  shop.file("a.nc", programWithoutFeed());
  shop.file(".ncvet.json", "{ // the lathe at the door: \"SL-20\" {\n  /* [ */ \"dialect\": "
                           "\"haas-lathe\",\n  \"select\": [\"feed-missing\"] // only this\n}\n");
  EXPECT_THAT(shop.findings({"a.nc"}), ElementsAre("a.nc:4 feed-missing"));
  shop.file(".ncvet.json", "{\n// \"dialect\": 1,\n\"dialect\": \"mefi\",\n\"dialect\": \"ecs\"}");
  const ProcessResult twice = shop.run({"check", "a.nc"});
  EXPECT_EQ(2, twice.exitCode);
  EXPECT_EQ("ncvet: error: .ncvet.json:4: dialect: the key is here twice\n", twice.err);
}

TEST(ConfigurationFiles, AnUnknownControlIsSaidWithItsFileAndLine) {
  Shop shop;
  shop.file("a.nc", programWithoutFeed());
  shop.file(".ncvet.json", "{\n\n\"dialect\": \"haas-lath\"}");
  EXPECT_THAT(shop.run({"check", "a.nc"}).err,
              HasSubstr(".ncvet.json:3: dialect: unknown dialect \"haas-lath\"; did you mean"));
}

TEST(ConfigurationFiles, ADeviceIsNone) {
  Shop shop;
  shop.file("a.nc", programWithoutFeed());
  for (const char *option : {"--config", "--machine", "--baseline"}) {
    const ProcessResult result = shop.run({"check", option, "/dev/zero", "a.nc"});
    EXPECT_EQ(2, result.exitCode);
    EXPECT_THAT(result.err, HasSubstr("cannot read /dev/zero: it is not a regular file"));
  }
  std::filesystem::create_symlink("/dev/zero", shop.path() / ".ncvet.json");
  EXPECT_THAT(shop.run({"check", "a.nc"}).err, HasSubstr("it is not a regular file"));
}

TEST(Baselines, OnStandardOutputAreAllOfIt) {
  Shop shop;
  shop.file("a.nc", programWithoutFeed());
  const ProcessResult result =
      shop.run(joined({"check", "--write-baseline", "-", "a.nc"}, missingFeeds));
  EXPECT_EQ(0, result.exitCode);
  const auto json = nlohmann::json::parse(result.out, nullptr, false);
  ASSERT_TRUE(json.is_object()) << result.out;
  EXPECT_EQ(1u, json["findings"].size());
  EXPECT_EQ("wrote 1 finding to standard output\n", result.err);
}

TEST(Reports, GoToTheFileThatIsNamedOrToStandardOutput) {
  Shop shop;
  shop.file("a.nc", programWithoutFeed());
  const ProcessResult file =
      shop.run(joined({"check", "--format", "json", "-o", "out.json", "a.nc"}, missingFeeds));
  EXPECT_EQ(1, file.exitCode);
  EXPECT_EQ("", file.out);
  EXPECT_THAT(shop.text("out.json"), HasSubstr("\"version\":1"));
  const ProcessResult standard = shop.run(
      joined({"check", "--report", "gcc:-", "--report", "json:b.json", "a.nc"}, missingFeeds));
  EXPECT_THAT(standard.out, HasSubstr("a.nc:4:"));
  EXPECT_THAT(standard.out, Not(HasSubstr("| ")));
  EXPECT_EQ(shop.text("out.json"), shop.text("b.json"));
}

TEST(ExitZero, IsTheCodeWhateverIsFound) {
  Shop shop;
  shop.file("a.nc", programWithoutFeed());
  EXPECT_EQ(0, shop.run(joined({"check", "--exit-zero", "a.nc"}, missingFeeds)).exitCode);
  EXPECT_EQ(2, shop.run(joined({"check", "--exit-zero", "none.nc"}, missingFeeds)).exitCode);
}

} // namespace
} // namespace ncvet::test
