// `explain`, `rules`, `dialects`, help and version through the real binary.
#include "tests/support/places.h"
#include "tests/support/process.h"

#include "gtest/gtest.h"
#include <gmock/gmock.h>

#include <filesystem>

namespace ncvet::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

TEST(ExplainCommand, ShowsThePageWithoutItsMetadataBlock) {
  Shop shop;
  const ProcessResult result = shop.run({"explain", "feed-missing"});
  EXPECT_EQ(0, result.exitCode);
  EXPECT_THAT(result.out, StartsWith("# feed-missing\n\nerror · feed · on by default"));
  EXPECT_THAT(result.out, HasSubstr("## Wrong"));
  EXPECT_THAT(result.out, Not(HasSubstr("\"summary\"")));
}

TEST(ExplainCommand, ShowsTheProgramsOfTheControlThatIsAskedFor) {
  Shop shop;
  const ProcessResult one = shop.run({"explain", "cycle-peck-invalid", "--dialect", "nct-104m"});
  EXPECT_THAT(one.out, HasSubstr("## Wrong\n\n```nc nct-104m\n"));
  EXPECT_THAT(one.out, HasSubstr("## Right\n\n```nc nct-104m\n"));
  EXPECT_THAT(one.out, Not(HasSubstr("```nc haas-lathe")));
  EXPECT_THAT(one.out, HasSubstr("## Wrong"));
  const ProcessResult unknown = shop.run({"explain", "feed-missing", "--dialect", "haas"});
  EXPECT_EQ(2, unknown.exitCode);
  EXPECT_THAT(unknown.err, HasSubstr("unknown dialect \"haas\""));
  // The shop's own control, where its configuration names one.
  shop.file(".ncvet.json", R"({ "dialect": "nct-104m" })");
  EXPECT_EQ(one.out, shop.run({"explain", "cycle-peck-invalid"}).out);
}

TEST(ExplainCommand, EveryRuleHasAPage) {
  Shop shop;
  for (const RuleEntry &entry : allRules())
    EXPECT_THAT(shop.run({"explain", entry.info.id.str()}).out,
                StartsWith(("# " + entry.info.id + "\n").str()));
}

TEST(RulesCommand, ListsEveryRuleAsJson) {
  Shop shop;
  const auto json =
      nlohmann::json::parse(shop.run({"rules", "--format", "json"}).out, nullptr, false);
  ASSERT_TRUE(json.is_object());
  ASSERT_EQ(allRules().size(), json["rules"].size());
  for (const auto &rule : json["rules"])
    for (const char *key :
         {"id", "category", "severity", "default", "summary", "fix", "dialects", "options"})
      EXPECT_TRUE(rule.contains(key)) << rule << " " << key;
}

TEST(RulesCommand, ListsEveryRuleForPeople) {
  Shop shop;
  const ProcessResult result = shop.run({"rules"});
  EXPECT_EQ(0, result.exitCode);
  for (const RuleEntry &entry : allRules())
    EXPECT_THAT(result.out, HasSubstr(("\n" + entry.info.id + " ").str()));
}

TEST(DialectsCommand, ListsThoseThatCanBeChosen) {
  Shop shop;
  const ProcessResult result = shop.run({"dialects"});
  EXPECT_EQ(0, result.exitCode);
  EXPECT_THAT(result.out, HasSubstr("haas-lathe"));
  EXPECT_THAT(result.out, Not(HasSubstr("iso-base ")));
}

TEST(DialectsCommand, ChecksATableOfOnesOwn) {
  Shop shop;
  shop.file("good.json", R"({"id": "mine", "title": "Mine", "extends": "haas-lathe"})");
  shop.file("bad.json", "{\"id\": \"mine\", \"title\": \"Mine\",\n\"extends\": \"haas-lathe\",\n"
                        "\"cods\": {}}");
  shop.file("marks.json", R"({"id": "mine", "title": "Mine", "extends": "haas-lathe",
      "detect": {"marks": [{"pattern": "G[0", "score": 1, "reason": "x"}]}})");
  EXPECT_EQ(0, shop.run({"dialects", "--check", "good.json"}).exitCode);
  const ProcessResult bad = shop.run({"dialects", "--check", "bad.json"});
  EXPECT_EQ(2, bad.exitCode);
  EXPECT_THAT(bad.err, HasSubstr("bad.json:3: cods: unknown key"));
  EXPECT_EQ(2, shop.run({"dialects", "--check", "marks.json"}).exitCode);
  EXPECT_EQ(2, shop.run({"dialects", "--check", "none.json"}).exitCode);
}

TEST(DialectsCommand, TakesEachOfTheBuiltInTables) {
  Shop shop;
  unsigned tables = 0;
  const auto folder = std::filesystem::path(places::sourceFolder()) / "rulesets" / "dialects";
  for (const auto &entry : std::filesystem::directory_iterator(folder)) {
    const ProcessResult result = shop.run({"dialects", "--check", entry.path().string()});
    EXPECT_EQ(0, result.exitCode) << result.err;
    ++tables;
  }
  EXPECT_LT(10u, tables);
}

TEST(CommandLine, HelpAndVersionAreOnStandardOutput) {
  Shop shop;
  EXPECT_THAT(shop.run({"--version"}).out, StartsWith("ncvet "));
  const ProcessResult help = shop.run({"--help"});
  EXPECT_EQ(0, help.exitCode);
  EXPECT_THAT(help.out, HasSubstr("ncvet check"));
  const ProcessResult check = shop.run({"check", "--help"});
  EXPECT_EQ(0, check.exitCode);
  EXPECT_THAT(check.out, HasSubstr("--fail-on"));
  EXPECT_EQ(2, shop.run({}).exitCode);
}

} // namespace
} // namespace ncvet::test
