// Globs of the configuration.
#include "analyzer/setup/config.h"
#include "analyzer/setup/globs.h"
#include "tests/support/places.h"
#include "tests/support/run_program.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace ncvet {
namespace {

bool matches(const char *glob, const char *path) {
  return Globs(std::vector<std::string>{glob}).match(path);
}

TEST(Globs, WithoutASlashMatchTheName) {
  EXPECT_TRUE(matches("*.nc", "a.nc"));
  EXPECT_TRUE(matches("*.nc", "deep/down/a.nc"));
  EXPECT_FALSE(matches("*.nc", "a.txt"));
  EXPECT_TRUE(matches("O[0-9]*", "sub/O1000"));
}

TEST(Globs, WithASlashMatchThePath) {
  EXPECT_TRUE(matches("old/*", "old/a.nc"));
  EXPECT_TRUE(matches("old/*", "old/deep/a.nc"));
  EXPECT_FALSE(matches("old/*", "new/old/a.nc"));
  EXPECT_TRUE(matches("**/old/*", "new/old/a.nc"));
  EXPECT_TRUE(matches("**/old/*", "old/a.nc"));
}

TEST(Globs, WithASlashAtTheEndMatchAFolder) {
  EXPECT_TRUE(matches("old/", "old/"));
  EXPECT_TRUE(matches("old/", "old/a.nc"));
  EXPECT_FALSE(matches("old/", "older/a.nc"));
}

TEST(Globs, StarsMatchAnyText) {
  EXPECT_TRUE(matches("a*b*c", "abc"));
  EXPECT_TRUE(matches("a*b*c", "a1b2bc"));
  EXPECT_FALSE(matches("a*b*c", "ab"));
  EXPECT_FALSE(matches("ab*bc", "abc")); // one letter is not used twice
  EXPECT_TRUE(matches("*", ""));
  EXPECT_TRUE(matches("[*]*\\**?", "*1*2"));
  EXPECT_FALSE(matches("[*]*\\**?", "11*2"));
}

/// Each star tried at each place inside each other: that would not end in this century.
TEST(Globs, ManyStarsCostLittle) {
  std::string glob, name;
  for (int i = 0; i < 100; ++i) {
    glob += "*a";
    name += "aa";
  }
  EXPECT_TRUE(matches(glob.c_str(), name.c_str()));
  EXPECT_FALSE(matches((glob + "*b").c_str(), name.c_str()));
}

TEST(FailOnLevel, IsReadByName) {
  EXPECT_EQ(FailOn(Severity::Warning), llvm::cantFail(parseFailOn("warning")));
  EXPECT_EQ(FailOn(), llvm::cantFail(parseFailOn("never")));
  EXPECT_TRUE(llvm::errorToBool(parseFailOn("").takeError()));
}

TEST(Profiles, EveryBuiltInProfileLoadsAndNamesKnownRules) {
  for (const std::string &name : profileNames())
    EXPECT_TRUE(bool(loadProfile(name))) << name;
  EXPECT_EQ((std::vector<std::string>{"all", "recommended", "strict"}), profileNames());
}

/// What the schema says there is, and what is read, are the same keys.
TEST(ConfigSchema, EveryKeyIsReadAndNoOther) {
  std::ifstream in(places::sourceFolder() + "/rulesets/schema/config.schema.json");
  const auto schema = nlohmann::json::parse(in, nullptr, false);
  ASSERT_TRUE(schema.is_object());
  test::TemporaryFolder folder;
  const std::string file = (folder.path() / ".ncvet.json").string();
  const auto problemOf = [&](const std::string &text) {
    std::ofstream(file) << text;
    auto config = loadConfig(file);
    return config ? std::string() : llvm::toString(config.takeError());
  };
  std::string known;
  for (const auto &property : schema["properties"].items()) {
    EXPECT_EQ(std::string::npos,
              problemOf("{\"" + property.key() + "\": true}").find("unknown key"))
        << property.key();
    known += (known.empty() ? "" : ", ") + property.key();
  }
  // The message for a key that resembles none lists all that there are.
  std::string listed = problemOf("{\"wwwwwwwwwwwwwwwwwwwwwwwwwww\": true}");
  listed = listed.substr(std::min(listed.size(), listed.find("one of ") + 7));
  EXPECT_EQ(std::count(known.begin(), known.end(), ','),
            std::count(listed.begin(), listed.end(), ','))
      << listed;
}

} // namespace
} // namespace ncvet
