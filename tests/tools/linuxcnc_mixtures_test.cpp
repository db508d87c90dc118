// Holds traces and errors of programs in which many features of LinuxCNC meet to its interpreter.
#include "tests/support/linuxcnc_comparison.h"
#include "tests/support/linuxcnc_mixtures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace ncvet;
using namespace ncvet::test;

namespace {

class LinuxCncMixtures : public LinuxCncComparison {};

/// NCVET_RS274_MIXTURES says how many programs are compared, NCVET_RS274_SEED which one alone.
TEST_F(LinuxCncMixtures, MoveAndAreJudgedAsByTheInterpreter) {
  const char *count = std::getenv("NCVET_RS274_MIXTURES"), *only = std::getenv("NCVET_RS274_SEED");
  const auto programs = uint32_t(count ? std::strtoul(count, nullptr, 10) : 120);
  Tally tally;
  Verdicts verdicts;
  const TemporaryFolder folder;
  for (uint32_t seed = 0; seed < programs; ++seed) {
    if (only && std::to_string(seed) != only)
      continue;
    constexpr uint32_t oneInThree = 3; // has a mistake
    const std::string text = withStart(LinuxCncMixture(seed).program(seed % oneInThree == 0));
    if (only)
      std::cout << text;
    std::ofstream(folder.path() / "made.ngc") << text;
    compareAndJudge(folder.path(), "made.ngc", "seed " + std::to_string(seed), tally, verdicts);
  }
  report("mixed programs", tally);
  report("mixed programs", verdicts);
  EXPECT_EQ(tally.agreeing, tally.programs);
  EXPECT_GE(verdicts.reported, 0.95 * verdicts.rejected);
  EXPECT_THAT(verdicts.wrong, testing::IsEmpty());
}

} // namespace
