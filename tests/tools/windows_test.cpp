// The program for Windows, under Wine, beside the one of this machine: it finds the same.
#include "tests/support/language_client.h"
#include "tests/support/outer_program.h"
#include "tests/support/places.h"
#include "tests/support/process.h"

#include <gmock/gmock.h>

namespace ncvet::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

/// A script that runs `ncvet.exe`; Wine's own folder outlives the tests, as it takes long to make.
class Windows : public ::testing::Test {
protected:
  void SetUp() override {
    const std::string program = places::sourceFolder() + "/build/windows/ncvet.exe";
    if (!std::filesystem::exists(program))
      GTEST_SKIP() << "./dev package windows has not been run here";
    if (!llvm::sys::findProgramByName("wine"))
      GTEST_SKIP() << "Wine is not installed: ./dev packages windows";
    const std::filesystem::path prefix = cacheFolder() / "wine";
    std::filesystem::create_directories(prefix);
    script_ = (folder_.path() / "ncvet").string();
    std::ofstream(script_) << "#!/bin/sh\nLC_ALL=C.UTF-8 WINEPREFIX=" << prefix.string()
                           << " WINEDEBUG=-all WINEDLLOVERRIDES='mscoree,mshtml=' exec wine "
                           << program << " \"$@\"\n";
    std::filesystem::permissions(script_, std::filesystem::perms::owner_all);
    shop_.binary(script_);
    if (shop_.run({"--version"}).exitCode != 0)
      GTEST_SKIP() << "Wine does not run here";
  }

  /// What both programs print of the same files, the report alone.
  void expectSame(const std::vector<std::string> &arguments) {
    std::filesystem::create_directory_symlink(places::sourceFolder() + "/tests",
                                              shop_.path() / "tests");
    const ProcessResult there = shop_.run(arguments);
    shop_.binary(places::program());
    const ProcessResult here = shop_.run(arguments);
    EXPECT_EQ(here.exitCode, there.exitCode) << there.err;
    EXPECT_EQ(here.out, there.out);
  }

  TemporaryFolder folder_;
  std::string script_;
  Shop shop_;
};

TEST_F(Windows, PrintsTheSameOfTheExamples) { expectSame({"check", "tests/programs/examples"}); }

TEST_F(Windows, FindsTheSameInAllProgramsOfTheTests) {
  expectSame({"check", "--format", "json", "--exit-zero", "--follow-links", "tests/programs"});
}

TEST_F(Windows, TracesTheSameMotions) { expectSame({"trace", "tests/programs/examples/bore.nc"}); }

TEST_F(Windows, TakesBackslashesDrivesAndNamesInAnyScript) {
  shop_.file("Teile/Welle ü 軸.nc", programWithoutFeed());
  EXPECT_THAT(shop_.findings(
                  {"--dialect", "haas-lathe", "--select", "feed-missing", "Teile\\Welle ü 軸.nc"}),
              ElementsAre("Teile/Welle ü 軸.nc:4 feed-missing"));
  const std::string drive = "Z:" + (shop_.path() / "Teile").string();
  EXPECT_THAT(shop_.findings({"--dialect", "haas-lathe", "--select", "feed-missing", drive}),
              ElementsAre(drive + "/Welle ü 軸.nc:4 feed-missing"));
}

TEST_F(Windows, FindsSettingsAndCalledProgramsOfTheFolder) {
  shop_.file("O0001.nc", "%\nO0001\nG21 G90 G0 X0 Y0\nM98 P0002\nM30\n%\n");
  shop_.file("sub/O0002.nc", "%\nO0002\nG1 X5.\nM99\n%\n");
  shop_.file(".ncvet.json", R"({"dialect": "fanuc-0m", "select": ["feed-missing"],
                                "searchFolders": ["sub"], "exclude": ["old/"]})");
  shop_.file("old/O0003.nc", "%\nO0003\nG1 X5.\nM30\n%\n");
  EXPECT_THAT(shop_.findings({"O0001.nc"}), ElementsAre("sub/O0002.nc:3 feed-missing"));
  EXPECT_THAT(shop_.findings({}), ElementsAre("sub/O0002.nc:3 feed-missing"));
}

TEST_F(Windows, FixesKeepLineEnds) {
  shop_.file("a.nc", "O0001\r\ng0 x1.\r\nM30\r\n");
  shop_.run({"check", "--dialect", "haas-lathe", "--select", "style-lower-case", "--fix", "a.nc"});
  EXPECT_EQ("O0001\r\nG0 X1.\r\nM30\r\n", shop_.text("a.nc"));
}

TEST_F(Windows, ColoursGoIntoAPipeWhenAskedFor) {
  shop_.file("a.nc", programWithoutFeed());
  const auto printed = [&](const char *when) {
    return shop_.run({"check", "--dialect", "haas-lathe", "--color", when, "a.nc"}).out;
  };
  EXPECT_THAT(printed("always"), HasSubstr("\x1b["));
  EXPECT_THAT(printed("auto"), Not(HasSubstr("\x1b[")));
}

TEST_F(Windows, ReadsAProgramFromStandardInput) {
  const ProcessResult result = shop_.run(
      {"check", "--dialect", "haas-lathe", "--select", "feed-missing", "-"}, programWithoutFeed());
  EXPECT_THAT(result.out, HasSubstr("<stdin>:4:"));
  EXPECT_EQ(1, result.exitCode);
}

TEST_F(Windows, ServesAnEditor) {
  LanguageClient client(script_);
  client.initialize();
  const std::string uri = "file:///c%3A/parts/O1.nc"; // as VS Code has it
  client.notify("textDocument/didOpen", {{"textDocument",
                                          {{"uri", uri},
                                           {"languageId", "nc-haas-lathe"},
                                           {"version", 1},
                                           {"text", programWithoutFeed()}}}});
  const Json published = client.notification("textDocument/publishDiagnostics");
  ASSERT_TRUE(published.is_object());
  EXPECT_EQ(published["uri"], "file:///c:/parts/O1.nc"); // the same to a client
  EXPECT_THAT(codes(published["diagnostics"]), ::testing::Contains("4 feed-missing"));
  EXPECT_EQ(client.request("shutdown", nullptr), Json());
}

} // namespace
} // namespace ncvet::test
