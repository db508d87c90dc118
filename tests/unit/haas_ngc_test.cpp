// What programs of the next generation Haas controls do that those of others do not.
#include "tests/support/written_trace.h"

#include "gmock/gmock.h"
#include "gtest/gtest.h"

namespace ncvet {
namespace {

using test::traceOf;
using ::testing::ElementsAre;

TEST(HaasNgc, AConditionGuardsAJumpByM99) {
  EXPECT_THAT(traceOf("haas-mill", "O1\nG21 G90\n#1=0\nN5 G0 X#1\n#1=#1+1\n[#1 LT 3] M99 P5\n"
                                   "G0 X9.\nM30\n"),
              ElementsAre("4 rapid X0", "4 rapid X1", "4 rapid X2", "7 rapid X9", "8 end"));
}

/// FANUC controls go to the block of the caller.
TEST(HaasNgc, M99WithPJumpsInsideTheRunningProgram) {
  EXPECT_THAT(traceOf("haas-mill", "O1\nG21 G90\nM98 P2\nN10 G0 X1.\nM30\n"
                                   "O2\nG0 X2.\nM99 P10\nX3.\nN10 X4.\nM99\n"),
              ElementsAre("7 rapid X2", "10 rapid X4", "4 rapid X1", "5 end"));
}

/// The loop that waits for a key is left: what was typed is not known.
TEST(HaasNgc, TheOperatorGivesAVariableItsValue) {
  EXPECT_THAT(traceOf("haas-mill", "O1\nG21 G90\n#501=0\nM109 P501\nIF [#501 EQ 0] GOTO9\n"
                                   "G0 X1.\nN9 M30\n"),
              ElementsAre("5 lost: what decides here is not known"));
}

TEST(HaasNgc, DecimalsOfAVariablesNumberAreRead) {
  EXPECT_THAT(traceOf("haas-mill", "O1\nG21 G90\n#1=#30003.078\nG0 X1.\nM30\n"),
              ElementsAre("4 rapid X1", "5 end"));
}

/// Patterns run the active cycle at each of their places, round the tool.
TEST(HaasNgc, ACircleOfHolesIsDrilledRoundTheTool) {
  EXPECT_THAT(traceOf("haas-mill", "O1\nG21 G90 G54 T1 M6\nG0 X10. Y0. Z5.\n"
                                   "G81 Z-2. R1. F100. L0\nG70 I5. J0. L2\nG80\nM30\n"),
              ElementsAre("2 tool 1", "3 rapid X10 Y0 Z5", "5 rapid X15 Y0 Z5", "5 rapid X15 Y0 Z1",
                          "5 linear X15 Y0 Z-2", "5 rapid X15 Y0 Z5", "5 rapid X5 Y0 Z5",
                          "5 rapid X5 Y0 Z1", "5 linear X5 Y0 Z-2", "5 rapid X5 Y0 Z5", "7 end"));
}

} // namespace
} // namespace ncvet
