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

/// The jump back is certain, the exit beside it is not: the variables change for ever.
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

/// Each of many jumps on an input leads somewhere else, and each path back brings another position:
/// what was followed from a place already is not followed again to the program's end.
TEST(Engine, ManyJumpsThatSomethingUnknownDecidesCostInProportion) {
  constexpr unsigned jumps = 1000;
  std::string program = "O1\nT101\nG54 G97 S800 M03\nG00 X50. Z3.\nG01 F0.2\n";
  for (unsigned i = 1; i <= jumps; ++i)
    program += "N" + std::to_string(i) + " M96 P" + std::to_string(i * 7919 % jumps + 1) +
               "\nG01 X" + std::to_string(20 + i % 30) + ".\n";
  EXPECT_TRUE(endsWithin(200 * jumps, "haas-lathe", program + "M30\n"));
}

/// What a call costs counts too: sections in sections, and subprograms in subprograms, end.
TEST(Engine, RepeatsOfRepeatsAreCut) {
  EXPECT_FALSE(endsWithin(50'000, "sinumerik",
                          "G0 X0 Y0\n"
                          "STEP: X=IC(0.001)\n"
                          "ROW: Y=IC(0.001)\n"
                          "REPEATB STEP P=9999\n"
                          "REPEAT ROW P=9999\n"
                          "M30\n"));
  EXPECT_FALSE(endsWithin(50'000, "sinumerik",
                          "%_N_PART_MPF\nG0 X0\nL5 P9999\nM30\n"
                          "%_N_L5_SPF\nL6 P9999\nM17\n"
                          "%_N_L6_SPF\nX=IC(0.001)\nM17\n"));
}

std::vector<std::string> findingsOf(const char *dialect,
                                    const std::vector<test::ProgramFile> &files) {
  std::vector<std::string> found;
  for (const test::Seen &seen : test::analyseProgram(
           dialect, files, "", [](const Dialect &table) { return RuleSelection::defaults(table); },
           /*allFiles=*/true))
    found.push_back((seen.file.empty() ? "" : seen.file + ":") + std::to_string(seen.line) + " " +
                    seen.rule);
  return found;
}

const std::string head = "N10 G54 G17 G71 G90 G94\nN20 T1 D1 M6\nN30 S2000 M3\n"
                         "N40 G0 X0 Y0\nN50 Z50\n";

/// A program of the same folder that is called like a cycle is the one that runs.
TEST(Engine, ProgramsHideTheCyclesOfTheirName) {
  const std::string call = head + "N60 CYCLE81(5)\nN70 G0 Z50 M5\nN80 M30\n";
  const std::string own = "PROC CYCLE81(REAL DEPTH)\nN10 G0 Z=DEPTH+10\nN20 M17\n";
  EXPECT_THAT(findingsOf("sinumerik", {{"PART.MPF", call}}),
              testing::Contains("6 cycle-missing-parameter"));
  const auto found = findingsOf("sinumerik", {{"PART.MPF", call}, {"CYCLE81.SPF", own}});
  EXPECT_THAT(found, testing::Not(testing::Contains("6 cycle-missing-parameter")));
  EXPECT_THAT(found, testing::Contains("6 program-name-reserved"));
  // In an archive.
  EXPECT_THAT(
      findingsOf("sinumerik", {{"PART.ARC", "%_N_PART_MPF\n" + call + "%_N_CYCLE81_SPF\n" + own}}),
      testing::Not(testing::Contains("7 cycle-missing-parameter")));
  // One of another kind of file is none.
  EXPECT_THAT(findingsOf("sinumerik", {{"PART.MPF", call}, {"CYCLE81.TXT", own}}),
              testing::Contains("6 cycle-missing-parameter"));
}

/// The arguments of a modal call, its missing program, and what comes after it.
TEST(Engine, ModalCallsAreChecked) {
  const std::string body = head + "N60 MCALL NOTCH(-3)\nN70 X10\nN80 MCALL\nN90 M5\nN95 M30\n";
  EXPECT_THAT(findingsOf("sinumerik", {{"PART.MPF", body}, {"OTHER.SPF", "N10 G0 X1\nN20 M17\n"}}),
              testing::Contains("6 flow-undefined-subprogram"));
  EXPECT_THAT(findingsOf("sinumerik",
                         {{"PART.MPF", body}, {"NOTCH.SPF", "N10 G0 Z5\nN20 G0 Z50\nN30 M17\n"}}),
              testing::Contains("6 flow-argument-mismatch"));
  // The program's own block is reached with the feed that is missing.
  EXPECT_THAT(
      findingsOf("sinumerik",
                 {{"PART.MPF", body},
                  {"NOTCH.SPF", "PROC NOTCH(REAL DEPTH)\nN10 G1 Z=DEPTH\nN20 G0 Z50\nN30 M17\n"}}),
      testing::Contains("NOTCH.SPF:2 feed-missing"));
}

/// A modal call whose program calls itself again ends.
TEST(Engine, ModalCallsEnd) {
  EXPECT_TRUE(endsWithin(20'000, "fanuc-0m",
                         "O0001\nG66P2A1.\nX1.\nM30\n"
                         "O0002\nG66P2A#1\nX[#1+1.]\nM99\n%\n"));
}

/// What a subprogram sets itself is known though nobody in the folder calls it.
TEST(Engine, ASubprogramWithoutACallerIsReadAsMostWouldCallIt) {
  EXPECT_THAT(findingsOf("fanuc-mill", {{"O9", "%\nO9\nG90 G17 G54 G21 G40\n"
                                               "S1000 M03\n"
                                               "G00 X0 Y0\n"
                                               "G01 X5. F100.\n"
                                               "G02 X10. Y0 I4. J0\n" // the centre is off by 1 mm
                                               "M05\n"
                                               "G01 X20.\n"
                                               "M99\n%\n"}}),
              testing::IsSupersetOf({"7 arc-radius-mismatch", "9 spindle-off-while-cutting"}));
  EXPECT_THAT(findingsOf("sinumerik", {{"ARC.SPF", "N10 G90 G17 G71 G54\n"
                                                   "N20 G0 X0 Y0\n"
                                                   "N30 G1 X5 F100\n"
                                                   "N40 G2 X10 Y0 I4 J0\n"
                                                   "N50 M17\n"}}),
              testing::Contains("4 arc-radius-mismatch"));
}

/// What its caller sets for it is not.
TEST(Engine, WhatACallerSetsIsNotKnownInASubprogramWithoutOne) {
  EXPECT_THAT(findingsOf("fanuc-mill", {{"O9", "%\nO9\nG01 X5. F100.\n"
                                               "G02 X10. I2.5\n"
                                               "G01 Z-2.\n"
                                               "M99\n%\n"}}),
              testing::IsEmpty());
}

/// Many write the subprograms of a file before the program that calls them.
TEST(Engine, TheMainProgramIsTheFirstThatDoesMoreThanReturn) {
  const std::string subprogram = "O1000\nG01 Z-1. F100.\nM99\n";
  const std::string mainProgram = "O7\nT1 M06\nG90 G54 G00 X0 Y0\nS500 M03\nG43 H01 Z5.\n"
                                  "M98 P1000\nG00 G53 G49 Z0.\nM30\n";
  EXPECT_THAT(findingsOf("haas-mill", {{"PART.nc", "%\n" + subprogram + mainProgram + "%\n"}}),
              testing::IsEmpty());
  // What it calls is checked as it calls it.
  EXPECT_THAT(
      findingsOf("haas-mill", {{"PART.nc", "%\nO1000\nG01 Z-1.\nM99\n" + mainProgram + "%\n"}}),
      testing::Contains("3 feed-missing"));
}

/// A mill's program that switches compensation on and off where the conditions say so.
std::vector<std::string> findingsOfGuards(const std::string &on, const std::string &between,
                                          const std::string &off) {
  return findingsOf("fanuc-mill", {{"O7", "%\nO7\nG21 G17 G90 G40 G49 G80\nT3 M6\n"
                                          "G54 G0 X-20. Y-20. S3200 M3\nG43 H3 Z50.\n"
                                          "Z2.\nG1 Z-6. F150.\n" +
                                              on +
                                              "G41 D3 G1 X0 Y-10. F400.\n"
                                              "N10 Y60.\n" +
                                              between + "X80.\n" + off +
                                              "G40 G1 X100. Y80.\n"
                                              "N20 G0 Z50.\n"
                                              "T4 M6\n"
                                              "M30\n"
                                              "O8\n#500=2\nM99\n%\n"}});
}

/// What a path has decided stays so while the program leaves the variables alone: the path on which
/// the first guard lets the compensation in, and the second does not let it out, is none.
TEST(Engine, APathDecidesOneConditionOnce) {
  const auto leftOn = testing::Contains(testing::EndsWith(" compensation-left-on"));
  const std::string on = "IF [#500 EQ 1] GOTO 10\n", off = "IF [#500 EQ 1] GOTO 20\n";
  EXPECT_THAT(findingsOfGuards(on, "", off), testing::Not(leftOn));
  EXPECT_THAT(findingsOfGuards(on, "", "IF [#500  EQ 1.0] GOTO 20\n"), testing::Not(leftOn));
  EXPECT_THAT(findingsOfGuards("IF [#500 GE 1] GOTO 10\n", "", "IF [#500 GE 1] GOTO 20\n"),
              testing::Not(leftOn));
  // Another variable, another value, a value that is given meanwhile, here or in a subprogram.
  EXPECT_THAT(findingsOfGuards(on, "", "IF [#501 EQ 1] GOTO 20\n"), leftOn);
  EXPECT_THAT(findingsOfGuards(on, "", "IF [#500 EQ 2] GOTO 20\n"), leftOn);
  EXPECT_THAT(findingsOfGuards(on, "#500=#501\n", off), leftOn);
  EXPECT_THAT(findingsOfGuards(on, "M98 P8\n", "IF [#500 GT 1] GOTO 20\n"), leftOn);
  // What the control itself counts is another number the next time.
  EXPECT_THAT(findingsOfGuards("IF [#3001 GT 9] GOTO 10\n", "", "IF [#3001 GT 9] GOTO 20\n"),
              leftOn);
}

/// The opposite comparison is decided as well, and brackets are as jumps.
TEST(Engine, APathDecidesTheOppositeConditionToo) {
  const auto program = [](const char *second) {
    return std::string("T1 M6\nG54 G90 G0 X0 Y0 Z50\n"
                       "IF R2==1\nS3000 M3\nENDIF\n") +
           second + "\nS800 M3\nENDIF\nG1 Z-1 F100\nG0 Z50 M5\nM30\n";
  };
  EXPECT_THAT(findingsOf("sinumerik", {{"PART.MPF", program("IF R2<>1")}}), testing::IsEmpty());
  EXPECT_THAT(findingsOf("sinumerik", {{"PART.MPF", program("IF NOT (R2==1)")}}),
              testing::IsEmpty());
  EXPECT_THAT(findingsOf("sinumerik", {{"PART.MPF", program("IF R2<>2")}}),
              testing::Contains("9 spindle-off-while-cutting"));
}

/// Paths that differ in nothing but what they have decided are one, for which nothing is decided:
/// both ways of the second condition are gone.
TEST(Engine, PathsThatMeetHaveDecidedNothing) {
  EXPECT_THAT(findingsOf("fanuc-mill", {{"O7", "%\nO7\nG21 G17 G90 G40 G49 G80\nT3 M6\n"
                                               "G54 G0 X0 Y0 S800 M3\nG43 H3 Z50.\n"
                                               "IF [#500 EQ 1] GOTO 10\n"
                                               "X10.\n"
                                               "N10 Y10.\n"
                                               "IF [#500 EQ 1] GOTO 20\n"
                                               "G1 Z-1.\n" // line 11: the feed is missing
                                               "N20 G0 Z50.\n"
                                               "M30\n%\n"}}),
              testing::Contains("11 feed-missing"));
}

} // namespace
} // namespace ncvet
