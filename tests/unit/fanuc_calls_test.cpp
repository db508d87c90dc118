// Calls of modern FANUC controls: the count before the number, names, blocks of the program.
#include "tests/support/written_trace.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ncvet {
namespace {

using test::traceOf;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Moves of a main program with this call; O20 steps in X by 1, O30020 by 5, `<SLOT>` in Y by 2.
std::vector<std::string> movesOf(const std::string &call) {
  std::vector<std::string> ends;
  for (const std::string &line :
       traceOf("fanuc-mill", "O1\nG90 G21 G0 X0 Y0\n" + call +
                                 "\nM30\nN500 G91 X7.\nM99\nO0020\nG91 X1.\nM99\nO30020\nG91 X5.\n"
                                 "M99\n<SLOT>\nG91 Y2.\nM99\n"))
    if (line.find("rapid") != std::string::npos && line.front() != '2')
      ends.push_back(line.substr(line.find("rapid") + 6));
  return ends;
}

TEST(FanucCalls, TheNumberOfAProgramMayHaveTheCountBeforeIt) {
  EXPECT_THAT(movesOf("M98 P20"), ElementsAre("X1 Y0"));
  EXPECT_THAT(movesOf("M98 P20020"), ElementsAre("X1 Y0", "X2 Y0"));
  EXPECT_THAT(movesOf("M98 P20 L2"), ElementsAre("X1 Y0", "X2 Y0"));
}

TEST(FanucCalls, AProgramWithAllDigitsOfTheNumberCountsFirst) {
  EXPECT_THAT(movesOf("M98 P30020"), ElementsAre("X5 Y0"));
}

TEST(FanucCalls, AreByNameToo) {
  EXPECT_THAT(movesOf("M98 <SLOT> L2"), ElementsAre("X0 Y2", "X0 Y4"));
}

TEST(FanucCalls, WithQAloneRunABlockOfTheSameProgram) {
  EXPECT_THAT(movesOf("M98 Q500"), ElementsAre("X7 Y0"));
}

TEST(FanucCalls, OfAnotherDeviceAreNotFollowed) {
  for (const std::string &line : traceOf("fanuc-mill", "O1\nM198 P20\nM30\nO20\nG0 X1.\nM99\n"))
    EXPECT_EQ(std::string::npos, line.find("rapid")) << line;
}

TEST(FanucCalls, OfTheBuildersCodesTakeAllWords) {
  for (const char *call : {"G187 P1 X5.", "M165 P9810 Z-10.", "G65 P9810 Z-10. F3000"})
    EXPECT_THAT(movesOf(call), IsEmpty()) << call;
}

/// What a sender writes over the first mark of the tape is for people, however many lines it has.
TEST(FanucTape, BeginsAfterCommentsOfTheSender) {
  const std::string program = "%\nN1 G0 X5.\nM30\n%\n";
  const std::vector<std::string> plain = traceOf("fanuc-mill", program);
  ASSERT_FALSE(plain.empty());
  for (const char *leader : {"(SENT BY DNC)\n", "(SENT BY DNC)\r\n\r\n(PART 7)\r\n(REV B)\r\n"})
    EXPECT_EQ(traceOf("fanuc-mill", leader + program).size(), plain.size()) << leader;
}

/// Two letters of a statement or of a function are enough (0i and later).
TEST(FanucStatements, MayBeCutToTwoLetters) {
  EXPECT_THAT(traceOf("fanuc-mill", "O1\nG90 G21\n#1=0\n"
                                    "WH[#1LT3]DO1\n"
                                    "#1=#1+1\n"
                                    "EN1\n"
                                    "IF[#1EQ3]GO10\n"
                                    "G00 X99.\n"
                                    "N10 G00 X[FI[2.9]]\nM30\n"),
              ElementsAre("9 rapid X2", "10 end"));
}

/// Lines at which the rule of the grammar speaks.
std::vector<uint32_t> misreadLines(const std::string &blocks) {
  std::vector<uint32_t> lines;
  for (const test::Seen &seen :
       test::analyseProgram("fanuc-mill", {{"PART.nc", "%\nO1\n" + blocks + "M30\n%\n"}}, "",
                            [](const Dialect &table) { return RuleSelection::defaults(table); }))
    if (seen.rule == "syntax-error")
      lines.push_back(seen.line);
  return lines;
}

TEST(FanucStatements, WhileWantsItsDoAndThenAStatement) {
  EXPECT_THAT(misreadLines("#1=0\nWHILE[#1LT3]\n#1=#1+1\nEND1\n"), ElementsAre(4u));
  EXPECT_THAT(misreadLines("#1=0\nIF[#1EQ0]THEN\n#1=1\nENDIF\n"), ElementsAre(4u));
}

} // namespace
} // namespace ncvet
