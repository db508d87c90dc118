// The machine's state at a block, in the words of a hover.
#include "analyzer/flow/states_at_block.h"
#include "lsp/features/showing/machine_state.h"
#include "tests/support/marked_text.h"

#include "gmock/gmock.h"
#include "gtest/gtest.h"

namespace {

using namespace ncvet;
using testing::HasSubstr;
using testing::Not;

/// The state before the block of the first mark.
std::string stateAt(llvm::StringRef dialect, llvm::StringRef program) {
  const auto text = test::markedText(dialect, program);
  Block block;
  text->readAt(text.marks[0], block);
  const StatesAt states = statesAt(text->project(), text->unit(), text->unit(), block.begin);
  return lsp::machineState(text->dialect(), states, text->project().sources());
}

TEST(MachineStateInWords, CodesOfPowerOnThatNoBlockNamesAreCounted) {
  const std::string state = stateAt("sinumerik", "G17 G54 G90 SOFT\nG0 X1 Y1\nX<|>5\nM30\n");
  EXPECT_THAT(state, HasSubstr("G54"));
  EXPECT_THAT(state, HasSubstr("SOFT"));
  EXPECT_THAT(state, HasSubstr(" more as at power-on"));
  EXPECT_THAT(state, Not(HasSubstr("FENDNORM")));
}

TEST(MachineStateInWords, PassesOfALoopAreToldWithOneTitle) {
  const std::string state = stateAt("fanuc-0m", "O1\nG90 G54 G0 X0. Y0.\n#1=0\nWHILE [#1LT3] DO1\n"
                                                "G0 X[#1*10.]\n#1=#1<|>+1\nEND1\nM30\n");
  EXPECT_EQ(llvm::StringRef(state).count("straight on:"), 1u) << state;
  EXPECT_THAT(state, HasSubstr("\nor:\n"));
}

TEST(MachineStateInWords, CallersThatDifferInNothingThatIsShownAreNotListed) {
  const std::string state = stateAt(
      "haas-lathe",
      "O1\nG21 G54 G99\nT101\nG97 S500 M03\nG00 X52. Z2.\nG71 P100 Q200 D2. U0.4 W0.1 F0.25\n"
      "N100 G00 X20.\nG01 Z-<|>20.\nN200 X52.\nG70 P100 Q200\nM30\n");
  EXPECT_THAT(state, HasSubstr("position: X 20, Z 2"));
  EXPECT_THAT(state, Not(HasSubstr("called here:\n\n\n"))) << state;
}

} // namespace
