// Programs that run, and are written in ways that look like mistakes: nothing is reported.
#include "analyzer/check/checker.h"
#include "analyzer/rule/rule_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ncvet {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;

/// "LINE RULE" of all errors and warnings.
std::vector<std::string> loud(const std::string &dialect, const std::string &text,
                              const std::string &name = "part.nc") {
  SessionOptions options;
  options.dialect = dialect;
  Session session(std::move(options));
  SourceSet sources;
  const SourceFile &file = sources.add(name, text);
  FileOutcome outcome = checkFile(session, sources, file);
  EXPECT_EQ("", outcome.error);
  std::vector<std::string> found;
  for (const CheckedFinding &checked : outcome.findings) {
    const Finding &finding = checked.finding;
    if (finding.severity != Severity::Style)
      found.push_back(std::to_string(file.lines().lineOf(finding.range.begin)) + " " +
                      allRules()[finding.rule].info.id.str());
  }
  return found;
}

constexpr const char *mill = "G21 G17 G40 G49 G80 G90 G94\nT1 M06\nG54 G00 X0. Y0. S1000 M03\n"
                             "G43 H01 Z50.\n";
constexpr const char *lathe = "O0001\nG21 G40 G97 G99\nT0101\nG50 S2000\n";

TEST(NearSilence, TheLimitOfTheSpindleMayFollowTheSurfaceSpeedAtOnce) {
  EXPECT_THAT(loud("haas-ngc-lathe", "O01021\nG20 G40 G80 G99\nT101\nG97 S1200 M03\nG00 X1. Z.1\n"
                                     "G96 S400\nG50 S3000\nG01 X-.03 F.008\nG00 Z.1\nM30\n"),
              IsEmpty());
  EXPECT_THAT(loud("haas-ngc-lathe", "O01021\nG20 G40 G80 G99\nT101\nG97 S1200 M03\nG00 X1. Z.1\n"
                                     "G96 S400\nG01 X-.03 F.008\nG50 S3000\nG00 Z.1\nM30\n"),
              ElementsAre("6 spindle-css-without-clamp"));
}

TEST(NearSilence, UnitsOfAnArchiveThatHoldDataAreNoPrograms) {
  const char *archive = "%_N_SHAFT_COM\n;$PATH=/_N_COM_DIR\n//M(mask1/\"title\"/)\n"
                        "DEF VAR1=(R///10/)\nLOAD\n//END\n"
                        "%_N_SHAFT_MPF\n;$PATH=/_N_MPF_DIR\nT1 D1\nM6\nS1000 M3\n"
                        "G54 G0 X0 Y0 Z10\nG1 Z-1 F100\nG0 Z100\nM30\n"
                        "%_N_INITIAL_INI\nN11660 $MN_NUM_EG=10\nCHANDATA(1)\nM17\n";
  EXPECT_THAT(loud("sinumerik", archive, "shaft.arc"), IsEmpty());
}

TEST(NearSilence, AfterAUnitOfDataAnotherProgramIsRead) {
  const char *archive = "%_N_INITIAL_INI\r\n$TC_DP1[1,1]=120\r\nM17\r\n"
                        "%_N_SHAFT_MPF\r\nG0 X5\r\nG1 Z-1\r\nM30\r\n";
  EXPECT_THAT(loud("sinumerik", archive, "shaft.arc"), ElementsAre("6 feed-missing"));
}

TEST(NearSilence, AFileOfDataIsNoProgram) {
  EXPECT_THAT(loud("sinumerik", "//M(mask1/\"title\"/)\nDEF VAR1=(R///10/)\n//END\n", "mask.com"),
              IsEmpty());
  EXPECT_THAT(loud("sinumerik", "N11660 $MN_NUM_EG=10\nM17\n", "nc.tea"), IsEmpty());
}

TEST(NearSilence, AnIndexOnAGCodeIsNoBracketThatIsOpen) {
  EXPECT_THAT(loud("sinumerik", "G0[10] X5\nM30\n"), ElementsAre("1 syntax-invalid-character"));
}

TEST(NearSilence, WhatASenderWroteBeforeTheTapeIsNotRead) {
  EXPECT_THAT(loud("fanuc-mill", std::string("(LOAD THE [FILE (1)] FIRST) )\n%\nO0001\n") + mill +
                                     "G00 Z100.\nM30\n%\n"),
              IsEmpty());
  EXPECT_THAT(loud("fanuc-mill", std::string("(LOAD THE [FILE (1)] FIRST) )\n\n%\n") + mill +
                                     "G00 Z100.\nM30\n%\n"),
              IsEmpty());
}

TEST(NearSilence, ARapidMoveDownAGrooveBeforeTheFeedIsNoPlunge) {
  const char *layers = "G0 Z2\nG1 Z-3 F180\nX20 F900\nG0 Z3\nX0\nG0 Z-2.5\nG1 Z-6 F180\n"
                       "X20 F900\nG0 Z50\n";
  EXPECT_THAT(
      loud("sinumerik", std::string("T1 D1\nM6\nG54 G0 X0 Y0 S9000 M3\n") + layers + "M30\n"),
      IsEmpty());
}

TEST(NearSilence, ATurretMayTurnWhereG01HasLedOutOfThePart) {
  EXPECT_THAT(loud("fanuc-lathe", std::string(lathe) +
                                      "G97 S800 M03\nG00 X22. Z2.\nG01 Z-20. F0.2\nX30.\nZ180.\n"
                                      "T0202\nG00 X100. Z100.\nM30\n"),
              IsEmpty());
  EXPECT_THAT(loud("fanuc-lathe", std::string(lathe) +
                                      "G97 S800 M03\nG00 X22. Z2.\nG01 Z-20. F0.2\nX30.\n"
                                      "T0202\nG00 X100. Z100.\nM30\n"),
              ElementsAre("9 tool-change-near-part"));
}

TEST(NearSilence, TheContourOfATurningCycleNeedsNoFeed) {
  EXPECT_THAT(loud("sinumerik", "G18 G90 G95 DIAMON\nLIMS=3000\nT1 D1\nG54\nG96 S200 M4\n"
                                "G0 X62 Z2\nCYCLE95(\"A:B\",2,0.1,0.2,,0.3,0.15,0.12,9)\n"
                                "G0 X100 Z100\nM30\nA: G1 X20 Z0\nZ-18\nX30\nZ-30\nB: X60\n"),
              IsEmpty());
}

TEST(NearSilence, ToolsOfATurretAreChangedByT) {
  EXPECT_THAT(loud("sinumerik", "G18 G90 G95 DIAMON\nLIMS=3000\nT1 D1\nG96 S200 M4\nG0 X30 Z2\n"
                                "G1 Z-5 F0.2\nG0 X100 Z100\nT2 D1\nG0 X20 Z2\nG1 Z-5\n"
                                "G0 X100 Z100\nT3 D1\nG0 X10 Z2\nG1 Z-5\nG0 X100 Z100\nM30\n"),
              IsEmpty());
}

TEST(NearSilence, WithACAxisTheDrillIsDriven) {
  EXPECT_THAT(loud("fanuc-lathe", std::string(lathe) +
                                      "G98 G97\nM41\nG28 H0.\nG00 C0.\nX80. Z20.\nS1500 M13\n"
                                      "G83 Z-15. R-15. Q4000 F150. M68\nC60.\nC120.\nG80 M69\n"
                                      "G00 Z20.\nM15\nG28 U0 W0\nM30\n"),
              IsEmpty());
}

TEST(NearSilence, AnElementOfAFieldTakesAValueBack) {
  EXPECT_THAT(loud("sinumerik",
                   "%_N_SHAFT_MPF\nDEF REAL FIELD[3,4]\nGROOVE(1,FIELD[2,1])\nM30\n"
                   "%_N_GROOVE_SPF\nPROC GROOVE(REAL DEEP, VAR REAL WIDE)\nWIDE=DEEP\nM17\n",
                   "shaft.arc"),
              IsEmpty());
}

TEST(NearSilence, AHaasMovesAtRapidAfterPowerOn) {
  EXPECT_THAT(loud("haas-ngc-lathe", "%\nO00001\nG53 X0.\nG53 Z0.\nT101\nM30\n%\n"), IsEmpty());
}

TEST(NearSilence, HolesWithoutAMotionCodeBeforeThemAreReachedAsTheMachineIsSet) {
  EXPECT_THAT(loud("sinumerik", "T1 D1\nM6\nG54 S950 M3\nF250\nMCALL CYCLE81(25,0,2,-22)\nX0 Y0\n"
                                "X20\nMCALL\nM30\n"),
              IsEmpty());
}

TEST(NearSilence, ABoreMayEndWithAMoveToItsMiddle) {
  const char *bore = "G97 S800 M03\nG00 X25. Z2.\nG71 U1. R0.3\nG71 P10 Q20 U-0.3 W0.1 F0.2\n"
                     "N10 G00 X90.\nG01 Z0. F0.1\nX88. Z-1.\nZ-25.\nN20 X0.\nG70 P10 Q20\n"
                     "G00 Z100.\nM30\n";
  EXPECT_THAT(loud("fanuc-lathe", std::string(lathe) + bore), IsEmpty());
}

TEST(NearSilence, AnOutsideContourMayLeaveThePartByALittle) {
  const char *shaft = "G97 S800 M03\nG00 X46. Z1.\nG71 U1. R0.2\nG71 P10 Q20 U0.3 W0.1 F0.35\n"
                      "N10 G01 X40.\nZ-10.\nX46.\nN20 U1.\nG70 P10 Q20\nG00 X100. Z100.\nM30\n";
  EXPECT_THAT(loud("fanuc-lathe", std::string(lathe) + shaft), IsEmpty());
}

TEST(NearSilence, AToolThatPartsOffIsInNoBore) {
  EXPECT_THAT(loud("fanuc-lathe", std::string(lathe) +
                                      "G97 S800 M03\nG00 X65. Z-19.\nG01 X60. F0.1\nX40. Z-22.\n"
                                      "X0.\nG00 X120. Z190.\nM30\n"),
              IsEmpty());
}

TEST(NearSilence, TheOffsetOfTheToolInUseMayComeWithItsCompensation) {
  EXPECT_THAT(loud("fanuc-lathe", "O4968\nG20 G40\nG50 S2000\nT0300\nG96 S854 M03\n"
                                  "G41 G00 X1.1 Z1.1 T0303 M08\nG01 Z1.0 F.05\nX-0.016\n"
                                  "G00 Z1.1\nG40 X4. Z4. M09\nG28 U0 W0\nM30\n"),
              IsEmpty());
}

TEST(StillReported, AJumpThatIsNotTakenNeedsItsTargetToo) {
  EXPECT_THAT(
      loud("fanuc-mill", "O0001\n#1=6\nIF[#1LE0]GOTO90\nIF[#1GT9]GOTO91\nM30\nN91#3000=1\n"),
      Contains("3 flow-undefined-target"));
  EXPECT_THAT(
      loud("sinumerik", "R1=6\nIF R1<=0 GOTOF NOWHERE\nIF R1>9 GOTOF LATE\nR2=R1\nLATE:\nM30\n"),
      Contains("2 flow-undefined-target"));
}

TEST(NearSilence, BlocksThatOnlyBranchAreNoneOfThePath) {
  EXPECT_THAT(loud("sinumerik", "T1 D1\nM6\nG54 G0 X0 Y0 Z10 S5000 M3\nR1=10 R5=0 R2=0.1\n"
                                "G1 Z=R5 F3000\nWHILE (R5>=-2)\nG1 G41 Y=R1 F1500\n"
                                "G2 X0 Y=R1 I0 J=-(R1)\nR1=R1+R2\nR5=R5-R2\nENDWHILE\n"
                                "G0 Z50\nG0 G40 X0 Y0\nM30\n"),
              IsEmpty());
}

TEST(NearSilence, ToolsThatTChangesHaveARadius) {
  EXPECT_THAT(loud("sinumerik", "G17 G90 G54\nT=\"MILL_20\" D1\nS2000 M3\nG0 X30 Y0 Z5\n"
                                "G1 Z-3 F100\nG41 X20 F300\nY10\nX-20\nG40 X-40\nG0 Z20\nM30\n"),
              IsEmpty());
}

TEST(NearSilence, AVariableWhoseNumberIsComputedIsNotTheVacantOne) {
  EXPECT_THAT(loud("fanuc-mill", "O0001\n#1=500\n#[#1+1]=0\n#[5201+#4014-53]=0\nM30\n"), IsEmpty());
}

TEST(NearSilence, FunctionsThatLookLikeOthersAreTheirOwn) {
  EXPECT_THAT(loud("sinumerik", "R1=BOUND(0,10,R2)\nR2=ROUND(R1)\nM30\n"), IsEmpty());
  EXPECT_THAT(loud("sinumerik", "R1=SQTR(R2)\nM30\n"), ElementsAre("1 syntax-unknown-name"));
}

TEST(NearSilence, TheLeadOfATapMayBelongToAnAxisThatAVariableNames) {
  EXPECT_THAT(loud("sinumerik", "DEF AXIS ALONG=Z\nT1 D1\nM6\nSPOS=0\nG0 X0 Y0 Z5\n"
                                "G331 AX[ALONG]=-10 IP[ALONG]=1.25 S=300\nG332 Z5 K1.25\nM30\n"),
              IsEmpty());
}

TEST(NearSilence, AMoveOfNoLengthIsOneOfTheBlocksThatAControlLooksPast) {
  EXPECT_THAT(loud("sinumerik", "T1 D1\nM6\nG54 G0 X-20 Y-20 Z10 S5000 M3\nG1 Z-1 F300\n"
                                "G41 X0 Y0\nY50\nY50\nX50\nY0\nX0\nG40 X-20 Y-20\nG0 Z50\nM30\n"),
              IsEmpty());
}

} // namespace
} // namespace ncvet
