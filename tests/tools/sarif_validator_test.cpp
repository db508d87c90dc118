// Holds SARIF reports to Microsoft's validator (npm: @microsoft/sarif-multitool), which checks them
// against the published schema and the rules for good reports. Skipped where npm cannot fetch it.
#include "tests/support/outer_program.h"
#include "tests/support/places.h"
#include "tests/support/sample_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

using namespace ncvet;
using namespace ncvet::test;

namespace {

namespace fs = std::filesystem;

constexpr const char *package = "@microsoft/sarif-multitool@5.7.0";

/// The validator's binary, fetched once into the build folder; nothing when that fails.
std::optional<fs::path> validator() {
  const fs::path folder = fs::path(places::program()).parent_path() / "sarif-multitool";
  const fs::path binary =
      folder / "node_modules" / "@microsoft" / "sarif-multitool-linux" / "Sarif.Multitool";
  if (!fs::exists(binary)) {
    // Into a folder of its own first, so that a fetch that is cut off leaves nothing half done.
    const fs::path fresh =
        folder.string() + "-" + std::to_string(llvm::sys::Process::getProcessId());
    fs::create_directories(fresh);
    runOuter({"npm", "install", "--prefix", fresh.string(), "--no-audit", "--no-fund",
              "--ignore-scripts", package},
             fresh / "npm.log", 240);
    std::error_code error;
    fs::rename(fresh, folder, error); // fails when another run was quicker, which is as good
    fs::remove_all(fresh, error);
  }
  if (!fs::exists(binary)) {
    std::error_code error;
    fs::remove_all(folder, error);
    return std::nullopt;
  }
  // The package's own script would set the run bit, but is not run.
  fs::permissions(binary, fs::perms::owner_exec, fs::perm_options::add);
  return binary;
}

/// A report with suppression, baseline and absent findings on top of the sample.
void addBaseline(SampleReport &sample) {
  sample.report.baselineUsed = true;
  sample.report.findings[0].suppressed = true;
  sample.report.findings[1].baselined = true;
  sample.report.absent = {{"missing-feed", "programs/sub.nc", "G1 without a feed", 9, 77}};
}

} // namespace

TEST(SarifValidatorTest, FindsNeitherErrorNorWarning) {
  const auto binary = validator();
  if (!binary)
    GTEST_SKIP() << "npm cannot fetch " << package << ": SARIF is checked by structure only";
  setenv("DOTNET_SYSTEM_GLOBALIZATION_INVARIANT", "1", 1); // it runs without libicu then

  const fs::path folder = fs::path(places::program()).parent_path() / "sarif-validator";
  fs::create_directories(folder);
  const auto validate = [&](const std::string &name, const std::string &sarif) {
    const fs::path file = folder / (name + ".sarif");
    std::error_code error;
    llvm::raw_fd_ostream(file.string(), error) << sarif;
    EXPECT_FALSE(error) << error.message();
    const fs::path log = folder / (name + ".log");
    // Its exit status says only whether there was an error.
    runOuter({binary->string(), "validate", file.string()}, log, 120);
    return contentsOf(log);
  };
  const auto expectClean = [&](const std::string &name, const Report &report) {
    const std::string said = validate(name, written("sarif", report));
    EXPECT_THAT(said, testing::HasSubstr("Analysis completed successfully"));
    EXPECT_THAT(said, testing::Not(testing::HasSubstr(": error "))) << said;
    EXPECT_THAT(said, testing::Not(testing::HasSubstr(": warning "))) << said;
  };

  SampleReport plain;
  expectClean("plain", plain.report);
  SampleReport baseline;
  addBaseline(baseline);
  expectClean("baseline", baseline.report);
  SampleReport absolute;
  const SourceFile &file = absolute.sources.add("/srv/nc/a b.nc", "(B\xF6hrer) G0\r");
  Finding finding = absolute.report.findings[0];
  finding.range = rangeOf(file, "G0");
  absolute.report.findings.push_back(finding);
  absolute.report.files.push_back({"/srv/nc/a b.nc", "haas-mill", 1, true, ""});
  sortReport(absolute.report);
  expectClean("absolute", absolute.report);
  SourceSet none;
  Report empty;
  empty.toolVersion = "0.1.0";
  empty.sources = &none;
  expectClean("empty", empty);

  // The check has teeth: a broken report is complained of.
  std::string broken = written("sarif", plain.report);
  broken.replace(broken.find("\"ruleIndex\":0"), 13, "\"ruleIndex\":9");
  EXPECT_THAT(validate("broken", broken), testing::HasSubstr(": error "));
}
