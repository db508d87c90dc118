// A crash in one file costs the result of this file: the others are reported, and the server lives.
#include "tests/support/language_client.h"
#include "tests/support/places.h"
#include "tests/support/process.h"
#include "tests/support/sanitized.h"

#include <gmock/gmock.h>

namespace ncvet::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class Crash : public ::testing::Test {
protected:
  void SetUp() override {
    if (sanitized)
      GTEST_SKIP() << "under a sanitizer a crash ends the process";
    shop.binary(places::crashingProgram());
    shop.file("good.nc", programWithoutFeed());
    shop.file("other.nc", programWithoutFeed());
  }
  ProcessResult check(const std::vector<std::string> &more = {}) const {
    std::vector<std::string> arguments = {"check", "--dialect", "haas-lathe", "."};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return shop.run(arguments);
  }
  static std::string programWith(const std::string &comment) {
    return "O1\nG21\nG97 S500 M03\n" + comment + " G00 X10.\nM30\n";
  }

  Shop shop;
};

class KindsOfCrash : public Crash,
                     public ::testing::WithParamInterface<std::pair<const char *, const char *>> {};

TEST_P(KindsOfCrash, CostsItsOwnFileOnly) {
  const auto [comment, what] = GetParam();
  shop.file("bad.nc", programWith(comment));
  const ProcessResult result = check();
  EXPECT_EQ(2, result.exitCode);
  EXPECT_THAT(result.err, HasSubstr("bad.nc: ncvet failed on this file"));
  EXPECT_THAT(result.err, HasSubstr(what));
  EXPECT_THAT(result.out, HasSubstr("good.nc:4:"));
  EXPECT_THAT(result.out, HasSubstr("other.nc:4:"));
}

INSTANTIATE_TEST_SUITE_P(All, KindsOfCrash,
                         ::testing::Values(std::pair("(CRASH)", "segmentation fault at bad.nc:4"),
                                           std::pair("(ABORT)", "abort at bad.nc:4"),
                                           std::pair("(OVERFLOW)",
                                                     "segmentation fault at bad.nc:4"),
                                           std::pair("(THROW)", "thrown by a rule")));

TEST_F(Crash, OfManyFilesSideBySideIsToldForEach) {
  for (char name = 'a'; name < 'm'; ++name)
    shop.file(std::string("bad-") + name + ".nc", programWith("(CRASH)"));
  const ProcessResult result = check({"--jobs", "4"});
  EXPECT_EQ(2, result.exitCode);
  for (char name = 'a'; name < 'm'; ++name)
    EXPECT_THAT(result.err, HasSubstr(std::string("bad-") + name + ".nc: ncvet failed"));
  EXPECT_THAT(result.out, HasSubstr("good.nc:4:"));
}

TEST_F(Crash, IsInTheReports) {
  shop.file("bad.nc", programWith("(CRASH)"));
  const ProcessResult result = check({"--format", "sarif"});
  const Json report = Json::parse(result.out);
  EXPECT_THAT(report.dump(), HasSubstr("ncvet failed on this file"));
}

TEST_F(Crash, LeavesTheServerAlive) {
  const std::string bad = (shop.path() / "bad.nc").string();
  const std::string good = (shop.path() / "good.nc").string();
  LanguageClient client(places::crashingProgram());
  client.initialize(Json::object(), {{"dialect", "haas-lathe"}});
  client.open(bad, programWith("(CRASH)"));
  client.diagnostics(bad);
  // A question about the program that cannot be followed is answered as well.
  client.request("textDocument/hover", {{"textDocument", documentOf(bad)}, {"position", at(4, 0)}});
  client.open(good, programWithoutFeed());
  EXPECT_FALSE(client.diagnostics(good).empty());
  // Without what makes it crash, it is checked again.
  client.notify("textDocument/didChange",
                {{"textDocument", {{"uri", "file://" + bad}, {"version", 2}}},
                 {"contentChanges", {{{"text", "O1\nG21\nG97 S500 M03\nG01 X10.\nM30\n"}}}}});
  EXPECT_THAT(client.diagnostics(bad, 2).dump(), HasSubstr("feed-missing"));
  EXPECT_EQ(client.shutDown(), 0);
}

} // namespace
} // namespace ncvet::test
