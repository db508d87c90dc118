// The npm package in Node: same findings as the program, exit codes, files, standard input, server.
// Skipped where it is not built.
#include "tests/support/language_client.h"
#include "tests/support/outer_program.h"
#include "tests/support/places.h"
#include "tests/wasm/wasm_package.h"

#include <gmock/gmock.h>

using namespace ncvet::test;
using testing::HasSubstr;

namespace {

namespace fs = std::filesystem;

/// The cycle of line 7 is left on and drills again in line 8.
constexpr const char *leftOver =
    "%\nO1200 (FLANGE, FANUC 0-M)\nG21 G17 G40 G49 G80 G90 G94\nT3 M6\n"
    "G54 G0 X-20. Y-15. S1400 M3\nG43 H3 Z50.\n"
    "G98 G83 X-20. Y-15. Z-22. R2. Q5. F120.\nX30. Y0. (TO CLAMP)\n"
    "M5\nG80\nM30\n%\n";

struct Measured {
  int status = -1;
  double seconds = 0; ///< of the processor, in the program's own code
  std::string out;
};

Measured measure(const std::vector<std::string> &command, const fs::path &out) {
  fs::remove(out);
  const std::vector<llvm::StringRef> words(command.begin(), command.end());
  const std::string name = out.string();
  const llvm::Optional<llvm::StringRef> streams[] = {llvm::StringRef(), llvm::StringRef(name),
                                                     llvm::StringRef()};
  llvm::Optional<llvm::sys::ProcessStatistics> spent;
  constexpr unsigned mostSeconds = 900;
  Measured result;
  result.status = llvm::sys::ExecuteAndWait(words.front(), words, llvm::None, streams, mostSeconds,
                                            0, nullptr, nullptr, &spent);
  result.seconds = spent ? double(spent->UserTime.count()) / 1e6 : 0;
  result.out = contentsOf(out);
  return result;
}

/// The package may take so many times as long as the program. Measured are 2.5.
constexpr double mostTimes = 3;

class WasmPackageOverPrograms : public WasmPackage {
protected:
  /// Checks the folder by both, and compares what they report.
  void compare(const fs::path &folder) {
    const std::vector<std::string> words = {"check", "--exit-zero", "--no-cache", "--jobs",
                                            "1",     "--format",    "json",       folder.string()};
    std::vector<std::string> program = {ncvet::places::program()}, package = {command()};
    program.insert(program.end(), words.begin(), words.end());
    package.insert(package.end(), words.begin(), words.end());
    const Measured expected = measure(program, shop_.path() / "program.json");
    const Measured given = measure(package, shop_.path() / "package.json");
    EXPECT_EQ(given.status, expected.status);
    EXPECT_GT(expected.out.size(), 1000u);
    // Texts of megabytes: where they differ is said, not all of both.
    const auto [at, other] =
        std::mismatch(expected.out.begin(), expected.out.end(), given.out.begin(), given.out.end());
    EXPECT_TRUE(at == expected.out.end() && other == given.out.end())
        << "from byte " << at - expected.out.begin() << " on:\n"
        << expected.out.substr(size_t(at - expected.out.begin()), 300) << "\nthe package says\n"
        << given.out.substr(size_t(other - given.out.begin()), 300);
    std::printf("%s: the program %.2f s, the package %.2f s of the processor\n",
                folder.filename().string().c_str(), expected.seconds, given.seconds);
    EXPECT_LT(given.seconds, expected.seconds * mostTimes + 2); // until it is compiled
  }
};

TEST_F(WasmPackageOverPrograms, FindsWhatTheProgramFindsInTheTestPrograms) {
  compare(fs::path(ncvet::places::sourceFolder()) / "tests" / "programs");
}

TEST_F(WasmPackageOverPrograms, FindsWhatTheProgramFindsInTheCorpus) {
  const fs::path corpus = fs::path(ncvet::places::sourceFolder()) / ".." / "shared" / "corpus";
  if (!fs::exists(corpus))
    GTEST_SKIP() << "the corpus is not beside the project";
  compare(fs::canonical(corpus));
}

TEST_F(WasmPackage, PrintsFindingsAndExitsAsTheProgramDoes) {
  shop_.file("bore.nc", leftOver);
  const ProcessResult found = shop_.run({"check", "--dialect", "fanuc-0m", "bore.nc"});
  EXPECT_THAT(found.out, HasSubstr("bore.nc:8:1"));
  EXPECT_EQ(found.exitCode, 0) << "warnings alone";
  EXPECT_EQ(shop_.run({"check", "--fail-on", "warning", "bore.nc"}).exitCode, 1);
  const ProcessResult missing = shop_.run({"check", "missing.nc"});
  EXPECT_EQ(missing.exitCode, 2);
  EXPECT_THAT(missing.err, HasSubstr("missing.nc"));
  EXPECT_EQ(shop_.run({"check", "--no-such-option"}).exitCode, 2);
}

TEST_F(WasmPackage, ReadsStandardInput) {
  const ProcessResult found = shop_.run({"check", "--dialect", "fanuc-0m", "-"}, leftOver);
  EXPECT_THAT(found.out, HasSubstr("cycle-unintended-execution"));
}

TEST_F(WasmPackage, TakesConfigurationAndVariablesOfTheProcess) {
  shop_.file("bore.nc", leftOver);
  shop_.file(".ncvet.json", R"({"dialect": "haas-mill"})");
  EXPECT_THAT(shop_.run({"check", "--format", "json", "bore.nc"}).out,
              HasSubstr("\"dialect\":\"haas-mill\""));
  EXPECT_THAT(shop_.run({"check", "--color", "always", "bore.nc"}).out, HasSubstr("\x1b["));
  EXPECT_THAT(shop_.run({"check", "bore.nc"}).out, testing::Not(HasSubstr("\x1b[")));
}

TEST_F(WasmPackage, WritesReportsAndFixesIntoFiles) {
  shop_.file("bore.nc", leftOver);
  shop_.run({"check", "--dialect", "fanuc-0m", "--report", "sarif:out/findings.sarif", "bore.nc"});
  shop_.run(
      {"check", "--dialect", "fanuc-0m", "-o", "findings.json", "--format", "json", "bore.nc"});
  EXPECT_THAT(shop_.text("findings.json"), HasSubstr("cycle-unintended-execution"));
  shop_.run({"check", "--dialect", "fanuc-0m", "--fix=all", "bore.nc"});
  EXPECT_THAT(shop_.text("bore.nc"), HasSubstr("G80\nX30. Y0. (TO CLAMP)"));
}

TEST_F(WasmPackage, ServesAnEditor) {
  LanguageClient client(command());
  EXPECT_EQ(client.initialize()["serverInfo"]["name"], "ncvet");
  const std::string path = (shop_.path() / "bore.nc").string();
  client.open(path, leftOver);
  const Json published = client.notification("textDocument/publishDiagnostics");
  EXPECT_THAT(codes(published["diagnostics"]), testing::Contains("8 cycle-unintended-execution"));
  const Json hover = client.request("textDocument/hover",
                                    {{"textDocument", documentOf(path)}, {"position", at(6, 5)}});
  EXPECT_THAT(hover.dump(), HasSubstr("G83"));
  EXPECT_EQ(client.shutDown(), 0);
}

TEST_F(WasmPackage, EndsWhenTheEditorIsGone) {
  LanguageClient gone(command());
  gone.initialize();
  gone.hangUp();
  EXPECT_EQ(gone.exitCode(), 1);
}

} // namespace
