// What whole ECS programs are told, and above all what they are not told.
#include "tests/support/run_program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ncvet {
namespace {

/// Rules that report something of `program`: "line rule".
std::vector<std::string> findings(const std::string &program) {
  std::vector<std::string> rules;
  for (const test::Seen &seen :
       test::analyseProgram("ecs", {{"PART.ecs", program}}, "", [](const Dialect &dialect) {
         return RuleSelection::defaults(dialect);
       }))
    rules.push_back(std::to_string(seen.line) + " " + seen.rule);
  return rules;
}

TEST(EcsPrograms, ACycleWithItsOwnSpeedLacksNone) {
  EXPECT_THAT(findings("%\n"
                       "N10 G16XYZ+ <CFF=CFZ>\n"
                       "N20 T5 M6\n"
                       "N30 G0 X0 Y0 Z50 G94\n"
                       "N40 G184 <ENT=-15> <RAP=3> <RAL=10> <SPD=300> <PCH=1.25> <ROT=3> <DAX=0>\n"
                       "N50 X20 Y20\n"
                       "N60 G150 Z100\n"
                       "N70 M30\n"),
              testing::Not(testing::Contains("5 spindle-speed-missing")));
}

/// What the caller of a program may have given is not missing when the program is checked alone.
TEST(EcsPrograms, ACalledProgramAloneIsNotToldOfArgumentsOfItsCaller) {
  const std::string called = "N10 G81 X10 Y10\n"
                             "N20 X20\n"
                             "N30 G80\n"
                             "N40 <RET>\n";
  const auto missing = testing::HasSubstr("cycle-missing-parameter");
  EXPECT_THAT(findings(called), testing::Not(testing::Contains(missing)));
  EXPECT_THAT(findings("%\nN1 G16XYZ+ <CFF=CFZ>\nN2 T1 M6\nN10 G81 X10 Y10\nN30 G80\nN40 M30\n"),
              testing::Contains(missing));
}

/// Around a cylinder the rotary axis is an axis of the plane.
TEST(EcsPrograms, ARotaryAxisMovesInItsPlane) {
  EXPECT_THAT(findings("%\n"
                       "N10 G16BYZ+\n"
                       "N20 T2 M6\n"
                       "N30 G0 Y110 Z220 B0 S800 M3\n"
                       "N40 G1 G42 B0 Y120 F150\n"
                       "N50 B250 Y120\n"
                       "N60 B600\n"
                       "N70 B850\n"
                       "N80 G0 G40 B900 Y110\n"
                       "N90 Z220 M5\n"
                       "N100 M30\n"),
              testing::Not(testing::Contains(testing::HasSubstr("compensation-idle-blocks"))));
}

TEST(EcsPrograms, RepeatsMayNestUpToTheControlsLevels) {
  std::string program = "%\nN1 G16XYZ+ <CFF=CFZ>\nN2 T1 M6\nN10 G0 DX1\n";
  const auto repeats = [&](int levels) {
    std::string text = program;
    for (int i = 0; i < levels; ++i)
      text += "N" + std::to_string(11 + i) + " <RPT:N10;N" + std::to_string(10 + i) + ";2>\n";
    return text + "N99 M30\n";
  };
  const auto tooDeep = testing::Contains(testing::HasSubstr("flow-nesting-too-deep"));
  EXPECT_THAT(findings(repeats(7)), testing::Not(tooDeep));
  EXPECT_THAT(findings(repeats(8)), tooDeep);
  EXPECT_THAT(findings(repeats(7)),
              testing::Not(testing::Contains(testing::HasSubstr("flow-recursion"))));
}

/// What `<TIM:ON>` has started may be read; before it nothing has set it.
TEST(EcsPrograms, TheStopwatchIsReadAfterItsStart) {
  const auto unset = testing::Contains(testing::HasSubstr("variable-read-before-write"));
  const std::string head = "%\nN10 G16XYZ+\nN20 T1 M6\n";
  EXPECT_THAT(findings(head + "N30 R0=V1025\nN40 M30\n"), unset);
  EXPECT_THAT(findings(head + "N25 <TIM:ON>\nN28 <TIM:OFF>\nN30 R0=V1025\nN40 M30\n"),
              testing::Not(unset));
}

/// On one path only the axes are named: that they are missing is not certain.
TEST(EcsPrograms, WhatOneWayHasSetIsNotMissing) {
  const std::string program = "%\n"
                              "N10 G16XYZ+\n"
                              "N20 T1 M6\n"
                              "N30 <INP:\"n\";R1;N60;1;9>\n"
                              "N40 <IFF<R1-5>:N50;N60;N60>\n"
                              "N50 <G69:AX=XYZ;E=0.02>\n"
                              "N60 G69\n"
                              "N70 G68\n"
                              "N80 M30\n";
  EXPECT_THAT(findings(program),
              testing::Not(testing::Contains(testing::HasSubstr("block-missing-word"))));
}

/// An element that a block defines is named, not driven to.
TEST(EcsPrograms, ADefinitionMovesNothing) {
  EXPECT_THAT(findings("%\n"
                       "N10 G16XYZ+\n"
                       "N20 T1 M6\n"
                       "N30 P2 = X-50 Y0\n"
                       "N40 O5 = G2 I0 J0 R50\n"
                       "N50 M30\n"),
              testing::Not(testing::Contains(testing::HasSubstr("spindle-off-while-cutting"))));
}

/// `L101` alone may be meant for a call: where a block defines the line it is the line.
TEST(EcsPrograms, ACommentDefinesNoElement) {
  const auto call = testing::Contains(testing::HasSubstr("flow-call-format"));
  const std::string head = "%\nN10 G16XYZ+\nN20 T1 M6\n", tail = "N50 L101\nN60 M30\n";
  EXPECT_THAT(findings(head + tail), call);
  EXPECT_THAT(findings(head + "' L101=P1 A45\n" + tail), call);
  EXPECT_THAT(findings(head + "N30 P1=X5 Y5\nN40 L101=P1 A45\n" + tail), testing::Not(call));
}

} // namespace
} // namespace ncvet
