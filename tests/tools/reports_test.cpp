// Every report form over many programs, each read back as its consumer reads it and compared with
// the JSON report of the same run: `tests/reports/read_back.py`.
#include "tests/support/outer_program.h"
#include "tests/support/places.h"
#include "tests/support/run_program.h"
#include "tests/support/thorough.h"

#include "gtest/gtest.h"

namespace {

namespace fs = std::filesystem;
using namespace ncvet::test;

class ReportForms : public ::testing::Test {
protected:
  /// Debian's own Python has Debian's packages.
  static constexpr const char *python = "/usr/bin/python3";

  void SetUp() override {
    if (runOuter({python, "-c", "import jsonschema, junitparser"}, log(), 30) != 0)
      GTEST_SKIP() << "./dev packages reports has not been run here";
  }

  void readBack(const fs::path &folder, const std::vector<std::string> &options) {
    std::vector<std::string> command = {
        python, "-B", ncvet::places::sourceFolder() + "/tests/reports/read_back.py",
        ncvet::places::program(), folder.string()};
    command.insert(command.end(), options.begin(), options.end());
    EXPECT_EQ(runOuter(command, log(), 300), 0) << contentsOf(log());
  }

  fs::path log() const { return folder_.path() / "log"; }

  TemporaryFolder folder_;
};

TEST_F(ReportForms, OfTheTestProgramsAreReadBack) {
  readBack(fs::path(ncvet::places::sourceFolder()) / "tests" / "programs",
           {"--", "--profile", "all", "--relative-to", ncvet::places::sourceFolder()});
}

TEST_F(ReportForms, OfTheCorpusAreReadBack) {
  const fs::path corpus = fs::path(ncvet::places::sourceFolder()) / ".." / "shared" / "corpus";
  if (!fs::exists(corpus))
    GTEST_SKIP() << "the corpus is not beside the project";
  readBack(fs::canonical(corpus), {"--", "--relative-to", fs::canonical(corpus).string(), "--shard",
                                   "1/" + std::to_string(tried(4, 1))});
}

} // namespace
