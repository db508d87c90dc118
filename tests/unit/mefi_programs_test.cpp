// What whole MEFI programs are told, and above all what they are not told.
#include "tests/support/run_program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ncvet {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

/// What is reported of `program`, whose control has `machine` as its profile: "line rule message".
std::vector<std::string> findings(const std::string &program, const std::string &machine = "",
                                  const char *further = nullptr) {
  std::vector<std::string> all;
  for (const test::Seen &seen :
       test::analyseProgram("mefi", {{"PART.ncp", program}}, machine, [&](const Dialect &dialect) {
         RuleSelection selection = RuleSelection::defaults(dialect);
         if (further) {
           const size_t rule = *test::ruleNamed(further);
           selection.enabled[rule] = selection.asked[rule] = true;
         }
         return selection;
       }))
    all.push_back(std::to_string(seen.line) + " " + seen.rule + " " + seen.message);
  return all;
}

TEST(MefiPrograms, AByteOrderMarkIsNoTextBeforeTheFirstBlock) {
  const std::string program = "N PROGRAM\nN10 G0 X0\nN ENDPROGRAM\n";
  EXPECT_THAT(findings("\xEF\xBB\xBF" + program),
              Not(Contains(HasSubstr("program-block-number-order"))));
  EXPECT_THAT(findings("\" flange N PROGRAM\nN1 G0 N2 X0\n"),
              Contains(HasSubstr("2 program-block-number-order")));
}

TEST(MefiPrograms, AQuoteOfWindowsOpensACommentAsOneOfUtf8Does) {
  const auto of = [](const char *quote) {
    return findings("N PROGRAM\nN10 G0 X0 " + std::string(quote) + " start b\nN ENDPROGRAM\n");
  };
  for (const char *quote : {"\xE2\x80\x9C", "\x93", "\x84", "\x94"}) {
    EXPECT_THAT(of(quote), Contains(HasSubstr("2 syntax-invalid-character")));
    EXPECT_THAT(of(quote), Not(Contains(HasSubstr("syntax-unknown"))));
  }
}

TEST(MefiPrograms, ThePriorityBlockMaySelectTheOrigin) {
  const std::string program = "N PROGRAM\nN10 G0 X0 Y0 Z50\nN ENDPROGRAM\n";
  const auto with = [&](const char *block) {
    return findings(program, std::string(R"({ "options": { "priorityBlock": ")") + block + "\" } }",
                    "coordinate-work-offset-not-set");
  };
  const auto missing = Contains(HasSubstr("coordinate-work-offset-not-set"));
  EXPECT_THAT(with("G17 G90 G94 G54"), Not(missing));
  EXPECT_THAT(with("G17 G90 G94"), missing);
}

TEST(MefiPrograms, EachCallHasItsOwnArguments) {
  EXPECT_THAT(findings("N PROGRAM\nN10 TRANSLATE(0,0,0) TRANSLATE(1,0,0)\nN ENDPROGRAM\n"),
              Not(Contains(HasSubstr("here are more"))));
  EXPECT_THAT(findings("N PROGRAM\nN10 TRANSLATE(0,0,0,1)\nN ENDPROGRAM\n"),
              Contains(HasSubstr("here are more")));
}

TEST(MefiPrograms, AStaleValueIsThatOfTheCycleThatItWasGivenFor) {
  const auto told = findings("N PROGRAM\n"
                             "N10 G0 G17 G90 G94 G54 X0 Y0 Z50\n"
                             "N20 M3 S800 F100\n"
                             "N30 G83 R28=5 R30=2 R31=-20 R32=10\n"
                             "N40 G80\n"
                             "N50 G87 X20 R29=1 R33=8 R34=0\n"
                             "N60 G80\n"
                             "N70 G86 X40 R29=1\n"
                             "N80 G80\n"
                             "N90 M5\n"
                             "N ENDPROGRAM\n");
  EXPECT_THAT(told, Contains(HasSubstr("6 cycle-stale-parameter `G87` has no R28 in its block and "
                                       "takes the one that was given for `G83`")));
  EXPECT_THAT(told, Contains(HasSubstr("8 cycle-stale-parameter `G86` has no R28 in its block and "
                                       "takes the one that was given for `G83`")));
}

/// A block in which a cycle runs unasked is told so once, by the rule that knows it best.
TEST(MefiPrograms, ABlockUnderACycleIsToldOnceThatItDrills) {
  const auto after = [](const char *block) {
    return findings("N PROGRAM\n"
                    "N10 G0 G17 G90 G94 G54 X0 Y0 Z50\n"
                    "N20 T4 M06\n"
                    "N30 M3 S800\n"
                    "N40 G81 F100 R30=2 R31=-15 R32=10\n"
                    "N50 " +
                    std::string(block) + "\nN60 G80\nN70 M5\nN ENDPROGRAM\n");
  };
  for (const char *block : {"M5", "T5", "R31=-20", "M00", "F80"})
    EXPECT_THAT(after(block), Not(Contains(HasSubstr("cycle-hole-drilled-twice")))) << block;
  EXPECT_THAT(after("M5"), Not(Contains(HasSubstr("cycle-left-active"))));
  EXPECT_THAT(after("M5"), Contains(HasSubstr("6 spindle-off-while-cutting")));
  EXPECT_THAT(after("T5"), Contains(HasSubstr("6 cycle-left-active")));
  EXPECT_THAT(after("R31=-20"), Contains(HasSubstr("6 mefi-cycle-fires-on-empty-block")));
}

/// What is before a piece of a program may have started the spindle.
TEST(MefiPrograms, AFragmentMayHaveASpindleThatTurns) {
  const auto stopped = Contains(HasSubstr("spindle-off-while-cutting"));
  EXPECT_THAT(findings("N10 G0 X20\nN20 G1 X40 F120\nN30 Y40\n"), Not(stopped));
  EXPECT_THAT(findings("N10 G81 F100 R30=2 R31=-15 R32=10\nN20 G80\n"), Not(stopped));
  EXPECT_THAT(findings("N10 M5\nN20 G1 X40 F120\n"), stopped);
  EXPECT_THAT(findings("N10 S500\nN20 G1 X40 F120\n"), stopped);
  EXPECT_THAT(findings("N10 G0 X20\nN20 G1 X40 F120\nN30 M30\n"), stopped);
}

} // namespace
} // namespace ncvet
