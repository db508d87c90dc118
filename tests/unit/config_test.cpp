// Globs of the configuration.
#include "analyzer/config.h"

#include <gtest/gtest.h>

namespace ncvet {
namespace {

bool matches(const char *glob, const char *path) {
  return matchesGlob(std::vector<std::string>{glob}, path);
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

} // namespace
} // namespace ncvet
