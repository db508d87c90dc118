// How O-words, parameters and expressions of LinuxCNC run (LinuxCNC 2.9 documentation, sections
// 11.4 and 11.7). A division by zero says which value a parameter has where it is.
#include "tests/support/run_program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ncvet {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Errors in `files`, of which the first is the main program: "line rule".
std::vector<std::string> errors(const std::vector<test::ProgramFile> &files) {
  std::vector<std::string> rules;
  for (const test::Seen &seen :
       test::analyseProgram("linuxcnc", files, "", [](const Dialect &dialect) {
         return RuleSelection::defaults(dialect);
       }))
    if (seen.rule.find("variable-") == 0 || seen.rule.find("flow-") == 0 ||
        seen.rule.find("syntax-") == 0)
      rules.push_back(std::to_string(seen.line) + " " + seen.rule);
  return rules;
}
std::vector<std::string> errors(const std::string &program) {
  return errors({{"part.ngc", program}});
}

TEST(LinuxCnc, AnAssignmentTakesEffectAfterTheWordsOfItsBlock) {
  EXPECT_THAT(errors("#1 = 5\n"
                     "#1 = 6 G0 X[1 / [#1 - 6]]\n"
                     "G0 X[1 / [#1 - 6]]\n"
                     "M2\n"),
              ElementsAre("3 variable-domain-error"));
}

TEST(LinuxCnc, ACallGivesItsArgumentsAndTakesNothingBackButTheValue) {
  EXPECT_THAT(
      errors("o<add> sub\n"
             "  #3 = [#1 + #2]\n"
             "  #31 = #3\n"
             "o<add> endsub [#3 * 10]\n"
             "#1 = 7\n"
             "o<Add> call [2] [3]\n"
             "G0 X[1 / [#1 - 7]]\n"
             "G0 X[1 / [#31 - 5]]\n"
             "G0 X[1 / [#<_value> - 50]]\n"
             "G0 X[1 / [#1 - 2]]\n"
             "M2\n"),
      ElementsAre("7 variable-domain-error", "8 variable-domain-error", "9 variable-domain-error"));
}

TEST(LinuxCnc, ArgumentsThatACallLeavesOutAreZero) {
  EXPECT_THAT(errors("o100 sub\n"
                     "  G0 X[1 / #2]\n"
                     "  #3 = 9\n"
                     "o100 endsub\n"
                     "#2 = 8 #3 = 5\n"
                     "o100 call [1]\n"
                     "G0 X[1 / [#3 - 5]]\n"
                     "M2\n"),
              ElementsAre("2 variable-domain-error", "7 variable-domain-error"));
}

TEST(LinuxCnc, OneBranchOfAnIfRuns) {
  const auto chain = [](const std::string &value) {
    return "#1 = " + value +
           "\n"
           "o1 if [#1 LT 0]\n"
           "  #2 = 1\n"
           "o1 elseif [#1 EQ 0]\n"
           "  #2 = 2\n"
           "  o2 if [1]\n"
           "    #3 = 1\n"
           "  o2 endif\n"
           "o1 else if [#1 EQ 1]\n"
           "  #2 = 3\n"
           "o1 else\n"
           "  #2 = 4\n"
           "o1 endif\n"
           "G0 X[1 / [#2 - 1]]\n"
           "G0 X[1 / [#2 - 2]]\n"
           "G0 X[1 / [#2 - 3]]\n"
           "G0 X[1 / [#2 - 4]]\n"
           "M2\n";
  };
  EXPECT_THAT(errors(chain("-5")), ElementsAre("14 variable-domain-error"));
  EXPECT_THAT(errors(chain("0")), ElementsAre("15 variable-domain-error"));
  EXPECT_THAT(errors(chain("1")), ElementsAre("16 variable-domain-error"));
  EXPECT_THAT(errors(chain("2")), ElementsAre("17 variable-domain-error"));
}

TEST(LinuxCnc, LoopsRunUntilTheirTestOrABreakEndsThem) {
  EXPECT_THAT(errors("#1 = 0 #2 = 0\n"
                     "o1 while [#1 LT 10]\n"
                     "  #1 = [#1 + 1]\n"
                     "  o2 if [#1 EQ 3]\n"
                     "    o1 continue\n"
                     "  o2 endif\n"
                     "  o3 if [#1 GT 5]\n"
                     "    o1 break\n"
                     "  o3 endif\n"
                     "  #2 = [#2 + 1]\n"
                     "o1 endwhile\n"
                     "G0 X[1 / [#1 - 6]]\n"
                     "G0 X[1 / [#2 - 4]]\n"
                     "M2\n"),
              ElementsAre("12 variable-domain-error", "13 variable-domain-error"));
  EXPECT_THAT(errors("#1 = 0 #2 = 0\n"
                     "o1 do\n"
                     "  #1 = [#1 + 1]\n"
                     "  o2 if [#1 EQ 2]\n"
                     "    o1 continue\n"
                     "  o2 endif\n"
                     "  #2 = [#2 + 1]\n"
                     "o1 while [#1 LT 3]\n"
                     "G0 X[1 / [#1 - 3]]\n"
                     "G0 X[1 / [#2 - 2]]\n"
                     "M2\n"),
              ElementsAre("9 variable-domain-error", "10 variable-domain-error"));
}

TEST(LinuxCnc, ALabelMayBeInBranchesThatExcludeEachOther) {
  const std::string branch = "o102 repeat [2]\nG0 X1\no102 endrepeat\n";
  EXPECT_THAT(errors("#1 = 5\no101 if [#1 EQ 1]\n" + branch + "o101 elseif [#1 EQ 5]\n" + branch +
                     "o101 else\n" + branch + "o101 endif\nM2\n"),
              IsEmpty());
  EXPECT_THAT(errors("#1 = 5\no101 if [#1 EQ 5]\n" + branch + branch + "o101 endif\nM2\n"),
              ElementsAre("6 flow-duplicate-label"));
}

/// The interpreter looks at an exit where it executes it, and at one with the label of a body that
/// it passes over (2.9.0).
TEST(LinuxCnc, AnExitInABranchThatIsNotTakenIsNotLookedAt) {
  EXPECT_THAT(errors("#1 = 5\no101 if [#1 EQ 1]\no105 break\no101 endif\nM2\n"), IsEmpty());
  EXPECT_THAT(errors("#1 = 5\no101 if [#1 EQ 1]\no101 break\no101 endif\nM2\n"),
              ElementsAre("3 flow-structure-mismatch"));
  EXPECT_THAT(errors("#1 = 5\no101 if [#1 EQ 5]\no105 break\no101 endif\nM2\n"),
              ElementsAre("3 flow-structure-mismatch"));
}

TEST(LinuxCnc, NothingLeadsOutOfALoopOrAnIfThatIsNeverClosed) {
  EXPECT_THAT(errors("o1 do\n"
                     "o1 continue\n"
                     "o2 if [1]\n"
                     "o2 elseif [1]\n"
                     "G0 X1\n"
                     "M2\n"),
              ElementsAre("1 flow-structure-mismatch", "2 flow-structure-mismatch",
                          "4 flow-structure-mismatch"));
}

/// rs274 goes into the body of what is never closed, and on; so the one is a warning.
TEST(LinuxCnc, AnIfWithoutItsEndIsAnErrorWhereItsBodyIsLeftOut) {
  const auto messages = [](const std::string &program) {
    std::vector<std::string> list;
    for (const test::Seen &seen :
         test::analyseProgram("linuxcnc", {{"part.ngc", program}}, "", [](const Dialect &dialect) {
           return RuleSelection::defaults(dialect);
         }))
      if (seen.rule == "flow-structure-mismatch")
        list.push_back(seen.message);
    return list;
  };
  EXPECT_THAT(messages("#1 = 1\no1 if [#1 EQ 1]\nG0 X1\nM2\n"),
              ElementsAre(HasSubstr("its body runs here")));
  EXPECT_THAT(messages("#1 = 1\no1 if [#1 EQ 2]\nG0 X1\nM2\n"),
              ElementsAre(HasSubstr("has no partner")));
  EXPECT_THAT(messages("o1 do\nG0 X1\nM2\n"), ElementsAre(HasSubstr("nothing repeats")));
}

/// What comes after it does not run, and after the IF its condition does not hold.
TEST(LinuxCnc, ACommentMayStopTheProgram) {
  EXPECT_THAT(errors("#1 = [#31]\n"
                     "o1 if [#1 EQ 0]\n"
                     "  ( Abort, #1 is nothing)\n"
                     "  G0 X[1 / 0]\n"
                     "o1 endif\n"
                     "(about, this is no stop)\n"
                     "G0 X[1 / [1 - 1]]\n"
                     "M2\n"),
              ElementsAre("7 variable-domain-error"));
}

/// A level of calls has modes of its own; M71 forgets them.
TEST(LinuxCnc, ModesComeBackOnlyWhereTheyWereKept) {
  EXPECT_THAT(errors("o1 sub\nM72\no1 endsub\n"
                     "M70\no1 call\nM72\nM72\nM71\nM72\nM73\nM72\nM2\n"),
              ElementsAre("2 flow-structure-mismatch", "9 flow-structure-mismatch"));
}

TEST(LinuxCnc, ARepeatCountsOnceAtItsHead) {
  EXPECT_THAT(errors("#1 = 3 #2 = 0\n"
                     "o1 repeat [#1]\n"
                     "  #1 = 100\n"
                     "  #2 = [#2 + 1]\n"
                     "o1 endrepeat\n"
                     "o2 repeat [0]\n"
                     "  #2 = 50\n"
                     "o2 endrepeat\n"
                     "G0 X[1 / [#2 - 3]]\n"
                     "M2\n"),
              ElementsAre("9 variable-domain-error"));
}

TEST(LinuxCnc, OperatorsBindAsTheLanguageSays) {
  EXPECT_THAT(errors("G0 X[1 / [[2 ** 3 ** 2] - 64]]\n"
                     "G0 X[1 / [[2 + 3 * 4 GT 5 AND 2] - 1]]\n"
                     "G0 X[1 / [FIX[-2.8] + 3]]\n"
                     "G0 X[1 / [FUP[-2.8] + 2]]\n"
                     "G0 X[1 / [[-2.5 MOD 2] - 1.5]]\n"
                     "G0 X[1 / [[1 EQ 1.00005] - 1]]\n"
                     "G0 X[1 / [[2 AND 4] - 1]]\n"
                     "G0 X[1 / [ATAN[1]/[1] - 45]]\n"
                     "M2\n"),
              ElementsAre("1 variable-domain-error", "2 variable-domain-error",
                          "3 variable-domain-error", "4 variable-domain-error",
                          "5 variable-domain-error", "6 variable-domain-error",
                          "7 variable-domain-error", "8 variable-domain-error"));
}

TEST(LinuxCnc, BlanksAndCaseDoNotCount) {
  EXPECT_THAT(errors("#<Tool Depth> = 5\n"
                     "g 0 x+0. 12 34y 7 z#<tooldepth>\n"
                     "#1 = [ 1 0 + 2 ]\n"
                     "G0 X[1 / [#1 - 12]]\n"
                     "m2\n"),
              ElementsAre("4 variable-domain-error"));
}

TEST(LinuxCnc, APolarWordWithoutAValueEndsWithItsCharacter) {
  EXPECT_THAT(errors("M2\nG0 @0^"), IsEmpty());
  EXPECT_THAT(errors("F100 G1 @1 ^\nM2\n"), ElementsAre("1 syntax-incomplete-word"));
  EXPECT_THAT(errors("G0 @1^"), ElementsAre("1 syntax-incomplete-word"));
}

TEST(LinuxCnc, ANamedParameterExistsFromItsFirstValueOn) {
  EXPECT_THAT(errors("o1 if [EXISTS[#<depth>]]\n"
                     "  G0 Z#<depth>\n"
                     "o1 endif\n"
                     "G0 Z#<depth>\n"
                     "G0 Z#<_somewhere_else>\n"
                     "M2\n"),
              ElementsAre("4 variable-read-before-write"));
}

TEST(LinuxCnc, LabelsOfASubprogramAreItsOwn) {
  EXPECT_THAT(errors("o100 sub\n"
                     "  o1 if [#1 GT 0]\n"
                     "    G0 X#1\n"
                     "  o1 endif\n"
                     "o100 endsub\n"
                     "o1 if [#31 GT 0]\n"
                     "  o100 call [5]\n"
                     "o1 endif\n"
                     "M2\n"),
              IsEmpty());
}

TEST(LinuxCnc, ASubprogramMayLieInAFileOfItsName) {
  EXPECT_THAT(errors({{"part.ngc", "o<drill> call [5]\n"
                                   "G0 X[1 / [#31 - 5]]\n"
                                   "o<missing> call\n"
                                   "M2\n"},
                      {"drill.ngc", "o<drill> sub\n"
                                    "  #31 = #1\n"
                                    "o<drill> endsub\n"
                                    "M2\n"}}),
              ElementsAre("2 variable-domain-error", "3 flow-undefined-subprogram"));
}

/// A turning cycle finds its contour where a call finds its subprogram.
TEST(LinuxCnc, TheContourOfACycleMayLieInAFileOfItsNumber) {
  EXPECT_THAT(errors({{"part.ngc", "G18 G90 F100\nG0 X14 Z2\no5 call\nG0 X14 Z2\n"
                                   "G71 Q5 I2\nG71 Q6 I2\nM2\n"},
                      {"5.ngc", "o5 sub\nG1 X10 Z0\nZ-5\nX12 Z-7\no5 endsub\nM2\n"}}),
              ElementsAre("6 flow-undefined-subprogram"));
}

TEST(LinuxCnc, AFileOfSubprogramsIsNoMainProgram) {
  EXPECT_THAT(errors("o<drill> sub\n"
                     "  G0 X#1\n"
                     "  o<elsewhere> call\n"
                     "o<drill> endsub\n"),
              IsEmpty());
}

} // namespace
} // namespace ncvet
