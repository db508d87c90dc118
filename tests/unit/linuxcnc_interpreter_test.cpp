// Where the tool goes on LinuxCNC, and for what it stops, in corners of its language: each as rs274
// of LinuxCNC 2.9 does it.
#include "tests/support/written_trace.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ncvet {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Lines with ` | ` between them, as one program.
std::string linesOf(llvm::StringRef text) {
  llvm::SmallVector<llvm::StringRef, 8> parts;
  text.split(parts, " | ");
  return llvm::join(parts, "\n") + "\n";
}

/// Where the tool goes, from the place X0 Y0 Z0 on.
std::vector<std::string> moves(llvm::StringRef text) {
  constexpr llvm::StringLiteral machine =
      R"({"dialect": "linuxcnc",
          "offsets": {"G54": {"X": 0, "Y": 0, "Z": 0}, "G55": {"X": 0, "Y": 0, "Z": 0},
                      "G59.3": {"X": 0, "Y": 0, "Z": 3}, "G92": {"X": 0, "Y": 0, "Z": 0}},
          "tools": {"5": {"length": 12.7}, "11": {"length": 27.94}}})";
  auto list = test::traceOf("linuxcnc", "G53 G0 X0 Y0 Z0\n" + linesOf(text), machine.str());
  list.erase(list.begin()); // the first place
  llvm::erase_if(list, [](const std::string &line) {
    return llvm::StringRef(line).contains("tool") || llvm::StringRef(line).endswith(" end");
  });
  for (std::string &line : list)
    line = line.substr(line.find(' ') + 1);
  return list;
}

/// Rules that say that the control stops.
std::vector<std::string> errorsOf(llvm::StringRef text) {
  std::vector<std::string> rules;
  test::withProgram("linuxcnc", {{"part.ngc", linesOf(text)}}, "",
                    [&](Project &project, FileUnit &unit) {
                      const auto selected = RuleSelection::defaults(*unit.dialect);
                      for (const Finding &found : analyze(project, unit, selected).findings)
                        if (found.severity == Severity::Error)
                          rules.push_back(allRules()[found.rule].info.id.str());
                    });
  return rules;
}

TEST(LinuxCncInterpretation, AFunctionMayFollowItsAddressDirectly) {
  EXPECT_THAT(moves("G0 XABS[-3] | G0 YFIX[2.7] ZSQRT[16] | M2"),
              ElementsAre("rapid X3 Y0 Z0", "rapid X3 Y2 Z4"));
  EXPECT_THAT(errorsOf("G0 XABS[-3] | M2"), IsEmpty());
  EXPECT_THAT(errorsOf("G0 XABSOLUTE[-3] | M2"), Contains("syntax-error"));
}

TEST(LinuxCncInterpretation, ATabMayBeBeforeTheBracketOfAFunction) {
  EXPECT_THAT(moves("G0 X[ATAN\t[1]/[1]] | M2"), ElementsAre("rapid X45 Y0 Z0"));
}

TEST(LinuxCncInterpretation, ASmallLIsTheAddressInSmallLetters) {
  EXPECT_THAT(errorsOf("g10l2p0x1 | g0x1 | m2"), IsEmpty());
  EXPECT_THAT(moves("g10l2p0x1 | g0x1 | m2"), ElementsAre("rapid X1 Y0 Z0"));
}

TEST(LinuxCncInterpretation, CommentsMayBeBetweenTheArgumentsOfACall) {
  EXPECT_THAT(moves("o<s> sub | G0 X#1 Y#2 | o<s> endsub | o<s> call [1] (note) [2] | M2"),
              ElementsAre("rapid X1 Y2 Z0"));
}

TEST(LinuxCncInterpretation, ZerosBeforeTheNumberOfAnOWordDoNotCount) {
  EXPECT_THAT(moves("o2 sub | G0 X1 | o2 endsub | o0002 call | M2"), ElementsAre("rapid X1 Y0 Z0"));
}

TEST(LinuxCncInterpretation, TheNumberOfABlockIsFirst) {
  EXPECT_THAT(errorsOf("(a) N3 | M2"), ElementsAre("syntax-invalid-character"));
  EXPECT_THAT(errorsOf("N3 (a) | M2"), IsEmpty());
}

TEST(LinuxCncInterpretation, AConditionNeedsItsBracket) {
  EXPECT_THAT(errorsOf("o1 if | o1 endif | M2"), Contains("syntax-error"));
}

TEST(LinuxCncInterpretation, ARepeatCountsToTheNearestWholeNumber) {
  EXPECT_THAT(moves("G91 | o1 repeat [2.7] | G0 X1 | o1 endrepeat | o2 repeat [0.3] | G0 Y1 | "
                    "o2 endrepeat | M2"),
              ElementsAre("rapid X1 Y0 Z0", "rapid X2 Y0 Z0", "rapid X3 Y0 Z0"));
}

TEST(LinuxCncInterpretation, G10L20GivesTheCoordinateItselfUnderG91) {
  EXPECT_THAT(moves("G0 X1 Y1 | G91 | G10 L20 P0 X4.3 | G0 Z1 | M2"),
              ElementsAre("rapid X1 Y1 Z0", "rapid X4.3 Y1 Z1"));
}

TEST(LinuxCncInterpretation, ModesThatComeBackSwitchTheShiftOfG92OffAgain) {
  EXPECT_THAT(moves("G0 X5 | M70 | G92 X-11 | M72 | G0 Z-3 | M2"),
              ElementsAre("rapid X5 Y0 Z0", "rapid X5 Y0 Z-3"));
}

TEST(LinuxCncInterpretation, VariablesOfTheControlSayWhatIsInForce) {
  EXPECT_THAT(moves("G21 G55 T5 M6 | G0 X#5220 Y#5400 | G0 Z[#<_coord_system> / 100] | "
                    "G0 X#<_metric> Y#<_imperial> | G91 G0 X#<_absolute> Y#<_incremental> | "
                    "F120 S300 | G90 G0 X#<_feed> Y#<_rpm> | M2"),
              ElementsAre("rapid X2 Y5 Z0", "rapid X2 Y5 Z5.5", "rapid X1 Y0 Z5.5",
                          "rapid X1 Y1 Z5.5", "rapid X120 Y300 Z5.5"));
}

TEST(LinuxCncInterpretation, APeckThatOnlyRoundingLeavesIsMade) {
  const auto pecks = [](llvm::StringRef depth) {
    return llvm::count_if(
        moves(("F100 M3 S100 | G0 Z5 | G83 X1 Z-" + depth + " R0 Q0.3 | M2").str()),
        [](const std::string &move) { return move.find("linear") == 0; });
  };
  EXPECT_EQ(pecks("0.9"), 4); // 0.3 + 0.3 + 0.3 is less in floating point
  EXPECT_EQ(pecks("0.6"), 2);
}

TEST(LinuxCncInterpretation, ARepeatedCycleTurnsOnByItsAngle) {
  EXPECT_THAT(moves("F100 M3 S100 | G0 X10 Z5 | G91 G81 Z-2 R-1 ^60 L2 | M2"),
              ElementsAre("rapid X10 Y0 Z5", "rapid X5 Y8.66 Z5", "rapid X5 Y8.66 Z4",
                          "linear X5 Y8.66 Z2", "rapid X5 Y8.66 Z4", "rapid X-5 Y8.66 Z4",
                          "linear X-5 Y8.66 Z2", "rapid X-5 Y8.66 Z4"));
}

TEST(LinuxCncInterpretation, G87GoesDownBesideTheBoreAndFeedsUp) {
  EXPECT_THAT(moves("F100 M3 S500 | G0 X1 Y1 Z5 | G87 X2 Y2 Z-1.1 R0.2 I1 J0 K-0.5 | M2"),
              ElementsAre("rapid X1 Y1 Z5", "rapid X2 Y2 Z5", "rapid X2 Y2 Z0.2",
                          "rapid X3 Y2 Z0.2", "rapid X3 Y2 Z-1.1", "rapid X2 Y2 Z-1.1",
                          "linear X2 Y2 Z-0.5", "linear X2 Y2 Z-1.1", "rapid X3 Y2 Z-1.1",
                          "rapid X3 Y2 Z0.2", "rapid X2 Y2 Z0.2"));
  EXPECT_THAT(errorsOf("F100 M3 S500 | G0 X1 Y1 Z5 | G87 X2 Y2 Z-1.1 R0.2 I1 J0 K-0.5 | M2"),
              IsEmpty());
  EXPECT_THAT(errorsOf("F100 M3 S500 | G0 X1 Y1 Z5 | G87 X2 Y2 Z-1.1 R0.2 I1 J0 | M2"),
              ElementsAre("cycle-missing-parameter"));
}

TEST(LinuxCncInterpretation, PolarWordsWorkInTheXyPlaneAwayFromZero) {
  EXPECT_THAT(errorsOf("G0 @-0.0025 ^20 | M2"), IsEmpty());
  EXPECT_THAT(errorsOf("G18 G0 @5 ^10 | M2"), ElementsAre("coordinate-polar-invalid"));
  EXPECT_THAT(errorsOf("G0 X0 Y0 | G91 G0 @5 | M2"), ElementsAre("coordinate-polar-invalid"));
  EXPECT_THAT(errorsOf("G0 X1 Y0 | G91 G0 @5 | M2"), IsEmpty());
}

TEST(LinuxCncInterpretation, LevelsOfACycleAreComparedAlongTheAxisOfThePlane) {
  EXPECT_THAT(errorsOf("F100 G18 G0 Y5 | G81 X1 Y-1 R-2 | M2"), ElementsAre("cycle-depth-order"));
  EXPECT_THAT(errorsOf("F100 G19 G0 X5 | G81 Y1 X-1 R-2 | M2"), ElementsAre("cycle-depth-order"));
  EXPECT_THAT(errorsOf("F100 G18 G0 Y5 | G81 X1 Y-1 R2 | M2"), IsEmpty());
  EXPECT_THAT(errorsOf("F100 G18 G0 Y5 | G81 X1 Z-5 R-1 | M2"),
              ElementsAre("cycle-missing-parameter"));
  EXPECT_THAT(errorsOf("F100 G19 G0 X5 | G81 Y1 Z-5 R-1 | M2"),
              ElementsAre("cycle-missing-parameter"));
}

TEST(LinuxCncInterpretation, BoringWithAStopNeedsTheSpindle) {
  EXPECT_THAT(errorsOf("F100 M5 | G0 Z5 | G86 X1 Z-1 R1 P0 | M2"),
              Contains("cycle-spindle-not-prepared"));
}

TEST(LinuxCncInterpretation, G53WorksWithG0AndG1Only) {
  for (const char *wrong : {"G53 | M2", "G0 X1 | G53 | M2", "F100 G53 G2 X1 Y1 R5 | M2",
                            "F100 G2 X1 Y1 R5 | G53 X2 | M2"})
    EXPECT_THAT(errorsOf(wrong), ElementsAre("coordinate-machine-move-state")) << wrong;
  EXPECT_THAT(errorsOf("G0 X1 | G53 X2 | M2"), IsEmpty());
  EXPECT_THAT(errorsOf("G0 X1 | G92 Y1 G53 | M2"), Contains("block-modal-group-conflict"));
}

TEST(LinuxCncInterpretation, SomeModesAreNotChangedUnderCompensation) {
  for (const char *code :
       {"G61", "G61.1", "G64", "G98", "G99", "G43 H1", "G43.1 Z1", "G43.2 H1", "G49"})
    EXPECT_THAT(errorsOf(std::string("F100 G41 D1 | ") + code + " | M2"),
                ElementsAre("compensation-forbidden-code"))
        << code;
  EXPECT_THAT(errorsOf("F100 G41 D1 | G40 G49 | M2"), IsEmpty());
}

TEST(LinuxCncInterpretation, ABlockTakesOneMCodeOfAGroup) {
  for (const char *wrong : {"M3 M3 | M2", "M7 M7 | M2", "M70 M5 | M2", "M70 M73 | M2"})
    EXPECT_THAT(errorsOf(wrong), ElementsAre("block-modal-group-conflict")) << wrong;
}

TEST(LinuxCncInterpretation, NumbersOfVariablesAndToolsAreWhole) {
  EXPECT_THAT(errorsOf("#1.5 = 2 | M2"), ElementsAre("variable-domain-error"));
  EXPECT_THAT(errorsOf("G10 L1 P0 Z1 | M2"), ElementsAre("block-value-out-of-range"));
}

TEST(LinuxCncInterpretation, AnOrientationOfTheToolIsForTheXzPlane) {
  EXPECT_THAT(errorsOf("G41.1 D3 L9 | M2"), ElementsAre("block-unused-word"));
  EXPECT_THAT(errorsOf("G18 G41.1 D3 L9 | M2"), IsEmpty());
}

} // namespace
} // namespace ncvet
