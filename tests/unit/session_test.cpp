// A session: which files its setups come from.
#include "analyzer/setup/session.h"
#include "tests/support/run_program.h"

#include <gtest/gtest.h>

#include <fstream>

namespace ncvet {
namespace {

/// A folder with a configuration, and a session that has set up a program in it.
class SetUpIn {
public:
  explicit SetUpIn(const std::string &configuration) {
    file("mill.json", R"({"dialect": "own-mill"})");
    file("own-mill.json", R"({"id": "own-mill", "title": "Own", "extends": "own-base"})");
    file("own-base.json", R"({"id": "own-base", "title": "Base", "extends": "haas-mill"})");
    file("base.json", R"({"ignore": ["style"]})");
    file(".ncvet.json", configuration);
  }
  bool dependsOn(const std::string &name) {
    if (auto setup = session_.setup((folder_.path() / "a.nc").string(), "O1\nM30\n"); !setup)
      llvm::consumeError(setup.takeError());
    return session_.dependsOn((folder_.path() / name).string());
  }

private:
  void file(const std::string &name, const std::string &text) {
    std::ofstream(folder_.path() / name) << text;
  }

  test::TemporaryFolder folder_;
  Session session_{SessionOptions()};
};

TEST(SessionFiles, AreConfigurationsTablesAndProfilesInUse) {
  SetUpIn setup(
      R"({"extends": "base.json", "dialects": ["own-mill.json"], "machine": "mill.json"})");
  for (const char *used : {".ncvet.json", "deeper/.ncvet.json", "base.json", "mill.json",
                           "own-mill.json", "own-base.json"})
    EXPECT_TRUE(setup.dependsOn(used)) << used;
  for (const char *other : {"a.nc", "other.json", "package.json", "deeper/base.json"})
    EXPECT_FALSE(setup.dependsOn(other)) << other;
}

TEST(SessionFiles, AreAllJsonFilesWhileOneCannotBeRead) {
  SetUpIn setup(R"({"machine": "missing.json"})");
  EXPECT_TRUE(setup.dependsOn("missing.json"));
  EXPECT_TRUE(setup.dependsOn("other.json"));
  EXPECT_FALSE(setup.dependsOn("a.nc"));
}

} // namespace
} // namespace ncvet
