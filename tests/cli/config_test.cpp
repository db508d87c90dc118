// Configuration through the real binary: which file counts, what it sets, how its errors are said.
#include "tests/support/process.h"

#include "gtest/gtest.h"
#include <gmock/gmock.h>

namespace ncvet::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

Shop &withProgram(Shop &shop, const std::string &name) {
  return shop.file(name, programWithoutFeed());
}

TEST(Configuration, TheNearestFileUpwardCounts) {
  Shop shop;
  withProgram(shop, "lathe/a.nc");
  withProgram(shop, "lathe/quiet/b.nc");
  shop.file(".ncvet.json", R"({"dialect": "haas-lathe", "select": ["feed-missing"]})");
  shop.file("lathe/quiet/.ncvet.json", R"({"dialect": "haas-lathe", "select": "style"})");
  EXPECT_THAT(shop.findings({}), ElementsAre("lathe/a.nc:4 feed-missing"));
}

TEST(Configuration, CommandLineGoesBeforeTheFile) {
  Shop shop;
  withProgram(shop, "a.nc");
  shop.file(".ncvet.json", R"({"dialect": "haas-lathe", "ignore": ["feed-missing"]})");
  EXPECT_THAT(shop.findings({"--select", "feed-missing"}), ElementsAre("a.nc:4 feed-missing"));
  shop.file("other.json", R"({"dialect": "haas-lathe", "select": ["feed-missing"]})");
  EXPECT_THAT(shop.findings({"--config", "other.json"}), ElementsAre("a.nc:4 feed-missing"));
}

TEST(Configuration, SeverityAndFailOnAreTakenFromIt) {
  Shop shop;
  withProgram(shop, "a.nc");
  shop.file(".ncvet.json", R"({"dialect": "haas-lathe", "select": ["feed-missing"],
                               "severity": {"feed-missing": "warning"}})");
  EXPECT_EQ(0, shop.run({"check", "a.nc"}).exitCode);
  shop.file(".ncvet.json", R"({"dialect": "haas-lathe", "select": ["feed-missing"],
                               "severity": {"feed": "warning"}, "failOn": "warning"})");
  EXPECT_EQ(1, shop.run({"check", "a.nc"}).exitCode);
}

TEST(Configuration, AnOverrideIsForSomeOfTheFiles) {
  Shop shop;
  withProgram(shop, "a.nc");
  withProgram(shop, "old/b.nc");
  withProgram(shop, "old/c.eia");
  shop.file(".ncvet.json", R"({"dialect": "haas-lathe", "select": ["feed-missing"],
    "overrides": [{"files": ["old/"], "ignore": ["feed-missing"]},
                  {"files": ["*.eia"], "extendSelect": ["feed-missing"],
                   "severity": {"feed-missing": "style"}}]})");
  EXPECT_THAT(shop.findings({}), ElementsAre("a.nc:4 feed-missing", "old/c.eia:4 feed-missing"));
  EXPECT_EQ(0, shop.run({"check", "--fail-on", "warning", "old/"}).exitCode);
  EXPECT_THAT(shop.run({"config", "old/b.nc"}).out, HasSubstr(".ncvet.json: overrides[0])\n"));
}

TEST(Configuration, AnOverrideNamesControlAndMachine) {
  Shop shop;
  withProgram(shop, "mill/a.nc");
  shop.file(".ncvet.json", R"({"dialect": "haas-lathe",
    "machine": {"dialect": "haas-lathe", "spindle": {"maxSpeed": 10}},
    "overrides": [{"files": ["mill/"], "dialect": "haas-mill", "failOn": "never",
      "machine": {"dialect": "haas-mill",
                  "spindle": {"maxSpeed": 9000}}}]})");
  EXPECT_EQ(0, shop.run({"check"}).exitCode);
  EXPECT_THAT(shop.run({"config", "mill/a.nc"}).out, HasSubstr("haas-mill"));
  EXPECT_THAT(shop.run({"check", "--stats"}).err,
              HasSubstr(".ncvet.json: overrides[0]), 5 blocks"));
}

TEST(Configuration, WhatIsWrongInAnOverrideIsNamedWithItsLine) {
  Shop shop;
  withProgram(shop, "a.nc");
  const auto error = [&](const std::string &json) {
    shop.file(".ncvet.json", json);
    return shop.run({"check", "a.nc"}).err;
  };
  EXPECT_THAT(error("{\n\"overrides\": [\n{\"ignore\": [\"style\"]}]}"),
              HasSubstr(".ncvet.json:3: overrides[0]"));
  EXPECT_THAT(error("{\n\"overrides\": [{\"files\": [\"a\"],\n\"dialect\": \"none\"}]}"),
              Not(HasSubstr("unknown dialect"))); // it is for no file here
  EXPECT_THAT(error("{\n\"overrides\": [{\"files\": [\"*.nc\"],\n\"dialect\": \"none\"}]}"),
              HasSubstr(".ncvet.json:3: overrides[0].dialect: unknown dialect"));
  EXPECT_THAT(error("{\"overrides\": [{\"files\": [\"*\"],\n\"extends\": \"strict\"}]}"),
              HasSubstr("overrides[0].extends: unknown key"));
}

TEST(Configuration, ExtendsAnotherFile) {
  Shop shop;
  withProgram(shop, "cell/a.nc");
  shop.file("shop.json", R"({"dialect": "haas-lathe", "select": ["feed-missing"]})");
  shop.file("cell/.ncvet.json", R"({"extends": "../shop.json",
                                    "severity": {"feed-missing": "style"}})");
  EXPECT_THAT(shop.findings({}), ElementsAre("cell/a.nc:4 feed-missing"));
  EXPECT_EQ(0, shop.run({"check", "--fail-on", "warning"}).exitCode);
}

TEST(Configuration, ExcludesAndAddsFilesOfFolders) {
  Shop shop;
  withProgram(shop, "a.nc");
  withProgram(shop, "old/b.nc");
  withProgram(shop, "c.pgm");
  withProgram(shop, "d_test.nc");
  shop.file(".ncvet.json", R"({"dialect": "haas-lathe", "select": ["feed-missing"],
                               "exclude": ["old/", "*_test.nc"], "files": ["*.pgm"]})");
  EXPECT_THAT(shop.findings({}), ElementsAre("a.nc:4 feed-missing", "c.pgm:4 feed-missing"));
  // What is named is checked.
  EXPECT_THAT(shop.findings({"old/b.nc"}), ElementsAre("old/b.nc:4 feed-missing"));
}

TEST(Configuration, SearchFoldersHoldSubprograms) {
  Shop shop;
  shop.file("main.nc", "O0001\nT101\nG97 S800 M03\nM98 P1000\nM30\n");
  shop.file("lib/O1000.nc", "O1000\nG01 X10. Z-5.\nM99\n");
  shop.file(".ncvet.json", R"({"dialect": "haas-lathe", "select": ["feed-missing"],
                               "searchFolders": ["lib"]})");
  EXPECT_THAT(shop.findings({"main.nc"}), ElementsAre("lib/O1000.nc:2 feed-missing"));
}

TEST(Configuration, DialectOfOnesOwnExtendsABuiltInOne) {
  Shop shop;
  withProgram(shop, "a.nc");
  shop.file("tables/bar.json", R"({"id": "bar-lathe", "title": "Bar lathe",
                                   "extends": "haas-lathe"})");
  shop.file(".ncvet.json", R"({"dialect": "bar-lathe", "dialects": ["tables/bar.json"],
                               "select": ["feed-missing"]})");
  EXPECT_THAT(shop.findings({}), ElementsAre("a.nc:4 feed-missing"));
  EXPECT_THAT(shop.run({"check", "--stats", "a.nc"}).err, HasSubstr("bar-lathe"));
  EXPECT_THAT(shop.run({"check", "--dialect", "tables/bar.json", "--stats", "a.nc"}).err,
              HasSubstr("bar-lathe"));
}

TEST(Configuration, MachineProfileIsInItOrBesideIt) {
  Shop shop;
  withProgram(shop, "a.nc");
  shop.file(".ncvet.json", R"({"machine": {"dialect": "haas-lathe"}, "select": "feed-missing"})");
  EXPECT_THAT(shop.findings({}), ElementsAre("a.nc:4 feed-missing"));
  shop.file("sl30.json", R"({"dialect": "haas-lathe"})");
  shop.file(".ncvet.json", R"({"machine": "sl30.json", "select": "feed-missing"})");
  EXPECT_THAT(shop.run({"check", "--stats", "a.nc"}).err,
              HasSubstr("haas-lathe (machine profile sl30.json)"));
}

TEST(Configuration, ErrorsNameFileLineAndWhatIsExpected) {
  const struct {
    const char *text;
    const char *said;
  } cases[] = {
      {"{\n\"dialct\": \"haas-lathe\"}",
       ".ncvet.json:2: dialct: unknown key; did you mean \"dialect\""},
      {"{\n\n\"failOn\": \"always\"}", ".ncvet.json:3: failOn: unknown level \"always\""},
      {"{\"select\": [\n\"feed-mising\"]}", ".ncvet.json:2: select[0]: unknown rule"},
      {"{\"severity\":\n{\"feed-missing\": \"loud\"}}", ".ncvet.json:2: severity.feed-missing: "},
      {"{\"options\":\n{\"arc-centre-missing\": {\"most\": 3}}}", "has no options"},
      {"{\"extends\": \"strictest\"}", ".ncvet.json:1: extends: unknown profile"},
      {"{\"extends\": \"none.json\"}", "none.json"},
      {"{\"extends\": \".ncvet.json\"}", "extend each other too deep"},
      {"{\n\"machine\": {\n\"axis\": {}}}", ".ncvet.json:3: axis: unknown key"},
      {"{\n\"machine\": \"none.json\"}", ".ncvet.json:2: machine: cannot read"},
      {"{\n\"dialects\": [\"none.json\"]}", "none.json"},
      {"{\n\"exclude\": [\"[a\"]}", ".ncvet.json:2: exclude[0]: a glob is expected"},
      {"{\n\"select\": [", ".ncvet.json:2: "},
      {"[]", ".ncvet.json:1: "},
  };
  for (const auto &c : cases) {
    Shop shop;
    withProgram(shop, "bad/a.nc");
    withProgram(shop, "good/b.nc");
    shop.file("bad/.ncvet.json", c.text);
    SCOPED_TRACE(c.text);
    const ProcessResult result = shop.run({"check", "--dialect", "haas-lathe", "--format", "json"});
    EXPECT_EQ(2, result.exitCode) << result.out;
    EXPECT_THAT(result.err, HasSubstr(c.said));
    EXPECT_EQ(1, std::count(result.err.begin(), result.err.end(), '\n')) << result.err;
    // The others are checked all the same.
    EXPECT_THAT(result.out, HasSubstr("good/b.nc"));
  }
}

TEST(Profiles, AllHasEveryRuleAndStrictAtLeastThoseOfRecommended) {
  Shop shop;
  const auto count = [&](const char *profile) {
    shop.file("a.nc", "o0001\n(ncvet: allow nothing-at-all)\ng01 x20 z-5.000000000\nm30\n");
    return shop.findings({"--dialect", "haas-lathe", "--profile", profile}).size();
  };
  EXPECT_GT(count("recommended"), 0u);
  EXPECT_LE(count("recommended"), count("strict"));
  EXPECT_LE(count("strict"), count("all"));
}

} // namespace
} // namespace ncvet::test
