// What the engine follows, and when it stops: loops without a known end, calls.
#include "tests/support/run_program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ncvet {
namespace {

bool endsWithin(uint64_t repeatedBlocks, const char *dialect, const std::string &program) {
  bool complete = false;
  test::withProgram(dialect, {{"PART.nc", program}}, "", [&](Project &project, FileUnit &unit) {
    AnalysisLimits limits;
    limits.repeatedBlocks = repeatedBlocks;
    complete = analyze(project, unit, RuleSelection::defaults(project.dialect()), limits).complete;
  });
  return complete;
}

/// The jump back is certain, the way out beside it is not: the variables change for ever.
TEST(Engine, LoopsThatSomethingUnknownEndsAreNotFollowedForEver) {
  EXPECT_TRUE(endsWithin(20'000, "fanuc-0m",
                         "O0001\n#1=0\n"
                         "N10G65P2A#1\n"
                         "#1=#1+1\n"
                         "IF[#500EQ1]GOTO30\n"
                         "GOTO10\n"
                         "N30M30\n"
                         "O0002\n#2=0\n"
                         "N20#2=#2+#1\n"
                         "#3=#3+#2\n"
                         "IF[#501GT#2]GOTO20\n"
                         "IF[#502EQ1]GOTO10\n"
                         "M99\n"
                         "N10GOTO20\n%\n"));
}

/// A loop that counts is followed to its end.
TEST(Engine, LoopsThatCountAreFollowed) {
  EXPECT_TRUE(endsWithin(20'000, "fanuc-0m",
                         "O0001\n#1=0\n"
                         "WHILE[#1LT1000]DO1\n"
                         "#1=#1+1\n"
                         "END1\n"
                         "IF[#1EQ1000]GOTO10\n"
                         "WHILE[#1GT0]DO2\n"
                         "#1=#1+1\n"
                         "END2\n"
                         "N10M30\n%\n"));
}

} // namespace
} // namespace ncvet
