// The motions of small programs, by their points.
#include "tests/support/written_trace.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ncvet {
namespace {

using testing::ElementsAre;

using test::traceOf;
using test::Written;

TEST(Trace, LinesAndArcsEndAtTheirPoints) {
  EXPECT_THAT(traceOf("nct-104m", "%O0001\n"
                                  "G90 G17 G0 X0 Y0 Z5\n"
                                  "G1 Z-1 F100\n"
                                  "G2 X20 Y0 I10 J0\n"
                                  "G3 X30 Y10 R10\n"
                                  "G3 I-10 J0\n"
                                  "M30\n%\n"),
              ElementsAre("2 rapid X0 Y0 Z5", "3 linear X0 Y0 Z-1", "4 arc X20 Y0 Z-1 cw 10/0 0.5",
                          "5 arc X30 Y10 Z-1 ccw 20/10 0.25", "6 arc X30 Y10 Z-1 ccw 20/10 1",
                          "7 end"));
}

TEST(Trace, RepeatedCallsRunAsOftenAsTheyAreCalled) {
  EXPECT_THAT(traceOf("nct-104m", "%O0001\nG90 G0 X0 Y0 Z5\nM98 P2 L3\nM30\n"
                                  "%O0002\nG91 G0 X10\nM99\n%\n"),
              ElementsAre("2 rapid X0 Y0 Z5", "6 rapid X10 Y0 Z5", "6 rapid X20 Y0 Z5",
                          "6 rapid X30 Y0 Z5", "4 end"));
}

std::vector<std::string> traceOf(const char *dialect, const std::vector<test::ProgramFile> &files) {
  Written written;
  test::withProgram(dialect, files, "",
                    [&](Project &project, FileUnit &unit) { trace(project, unit, {}, written); });
  return written.lines;
}

/// The control computes a comparison's result like any number: the condition has one answer.
TEST(Trace, ABranchIsChosenByComparisonsJoinedByAnd) {
  const auto moves = [](const std::string &second) {
    return traceOf("sinumerik", {{"PART.MPF", "G17 G90 G0 X0 Y0 Z5\nR1=1 R2=" + second +
                                                  "\nIF (R1 == 1 AND R2 == 1)\nX1\nELSE\nX2\n"
                                                  "ENDIF\nM30\n"}});
  };
  EXPECT_THAT(moves("1"), ElementsAre("1 rapid X0 Y0 Z5", "4 rapid X1 Y0 Z5", "8 end"));
  EXPECT_THAT(moves("0"), ElementsAre("1 rapid X0 Y0 Z5", "6 rapid X2 Y0 Z5", "8 end"));
}

/// Every block with a motion runs the program that `MCALL` names; its own motions do not.
TEST(Trace, ModalCallsRunAfterMoves) {
  EXPECT_THAT(traceOf("sinumerik", {{"PART.MPF", "G17 G90 G0 X0 Y0 Z20\n"
                                                 "MCALL NOTCH(-3)\n"
                                                 "X10\n"
                                                 "M8\n"
                                                 "G1 F200\n"
                                                 "MCALL\n"
                                                 "G0 X50\n"
                                                 "M30\n"},
                                    {"NOTCH.SPF", "PROC NOTCH(REAL DEPTH)\n"
                                                  "G1 Z=DEPTH F100\n"
                                                  "G91 G0 Z23\n"
                                                  "G90\n"
                                                  "M17\n"}}),
              ElementsAre("1 rapid X0 Y0 Z20", "3 rapid X10 Y0 Z20", "2 linear X10 Y0 Z-3",
                          "3 rapid X10 Y0 Z20", "2 linear X10 Y0 Z-3", "3 rapid X10 Y0 Z20",
                          "7 rapid X50 Y0 Z20", "8 end"));
}

/// The last call runs first; after the motions of its program the one before it runs.
TEST(Trace, ModalMacrosNest) {
  EXPECT_THAT(traceOf("fanuc-0m", "%\nO0001\nG90G17G0X0Y0Z50.\n"
                                  "G66P9100Z-5.R2.\n"
                                  "X10.\n"
                                  "G66P9200A3.\n"
                                  "X20.\n"
                                  "G67\n"
                                  "X30.\n"
                                  "G67\n"
                                  "X40.\n"
                                  "M30\n"
                                  "O9100\nG90G0Z#18\nZ50.\nM99\n"
                                  "O9200\nG91G0Y#1\nG90\nM99\n%\n"),
              ElementsAre("3 rapid X0 Y0 Z50", "5 rapid X10 Y0 Z50", "14 rapid X10 Y0 Z2",
                          "15 rapid X10 Y0 Z50", "7 rapid X20 Y0 Z50", "18 rapid X20 Y3 Z50",
                          "14 rapid X20 Y3 Z2", "15 rapid X20 Y3 Z50", "9 rapid X30 Y3 Z50",
                          "14 rapid X30 Y3 Z2", "15 rapid X30 Y3 Z50", "11 rapid X40 Y3 Z50",
                          "12 end"));
}

TEST(Trace, DrillingIsTakenApart) {
  EXPECT_THAT(traceOf("nct-104m", "%O0001\nG90 G0 X0 Y0 Z50 S500 M3\n"
                                  "G99 G83 X10 Y0 Z-20 R2 Q8 E1 F80\n"
                                  "G98 X30\n"
                                  "G80 M30\n%\n"),
              ElementsAre("2 rapid X0 Y0 Z50", "3 rapid X10 Y0 Z50", "3 rapid X10 Y0 Z2",
                          "3 linear X10 Y0 Z-6", "3 rapid X10 Y0 Z2", "3 rapid X10 Y0 Z-5",
                          "3 linear X10 Y0 Z-14", "3 rapid X10 Y0 Z2", "3 rapid X10 Y0 Z-13",
                          "3 linear X10 Y0 Z-20", "3 rapid X10 Y0 Z2", "4 rapid X30 Y0 Z2",
                          "4 linear X30 Y0 Z-6", "4 rapid X30 Y0 Z2", "4 rapid X30 Y0 Z-5",
                          "4 linear X30 Y0 Z-14", "4 rapid X30 Y0 Z2", "4 rapid X30 Y0 Z-13",
                          "4 linear X30 Y0 Z-20", "4 rapid X30 Y0 Z50", "5 end"));
}

/// A shift, a rotation about a point, and back: points in the coordinates of the work offset.
TEST(Trace, FramesAreResolved) {
  EXPECT_THAT(traceOf("nct-104m", "%O0001\nG90 G17 G0 X0 Y0 Z5\n"
                                  "G68 X10 Y0 R90\n"
                                  "X20\n"
                                  "G69\n"
                                  "G91 X1\n"
                                  "M30\n%\n"),
              ElementsAre("2 rapid X0 Y0 Z5", "4 rapid X0 Y10 Z5", "6 rapid X1 Y10 Z5", "7 end"));
  EXPECT_THAT(traceOf("sinumerik", "G17 G90 G0 X0 Y0 Z5\n"
                                   "TRANS X20 Y10\n"
                                   "AROT RPL=90\n"
                                   "X5\n"
                                   "MIRROR X0\n"
                                   "X5 Y0\n"
                                   "TRANS\n"
                                   "M30\n"),
              ElementsAre("1 rapid X0 Y0 Z5", testing::StartsWith("4 rapid"), "6 rapid X-5 Y0 Z5",
                          "8 end"));
}

TEST(Trace, PolarInputIsAnAngleAndARadius) {
  EXPECT_THAT(traceOf("nct-104m", "%O0001\nG90 G17 G0 X0 Y0 Z5\nG16 X20 Y90\nY180\nG15\nM30\n%\n"),
              ElementsAre("2 rapid X0 Y0 Z5", "3 rapid X0 Y20 Z5", "4 rapid X-20 Y0 Z5", "6 end"));
  EXPECT_THAT(traceOf("sinumerik", "G17 G90 G0 X0 Y0 Z5\nG111 X50 Y50\nG0 AP=0 RP=30\nAP=90\n"
                                   "M30\n"),
              ElementsAre("1 rapid X0 Y0 Z5", "3 rapid X80 Y50 Z5", "4 rapid X50 Y80 Z5", "5 end"));
}

TEST(Trace, CornersArePutIn) {
  EXPECT_THAT(traceOf("sinumerik", "G17 G90 G0 X0 Y0 Z0\n"
                                   "G1 X60 CHF=4 F100\n"
                                   "Y40 RND=8\n"
                                   "X0 CHR=3\n"
                                   "Y0\n"
                                   "M30\n"),
              ElementsAre("1 rapid X0 Y0 Z0", "2 linear X57.172 Y0 Z0", "2 linear X60 Y2.828 Z0",
                          "3 linear X60 Y32 Z0", "3 arc X52 Y40 Z0 ccw 52/32 0.25",
                          "4 linear X3 Y40 Z0", "4 linear X0 Y37 Z0", "5 linear X0 Y0 Z0",
                          "6 end"));
}

/// Copies of a hole, row by row and back, turned about the first one.
TEST(Trace, AGridOfHolesIsDrilledToAndFro) {
  const std::string grid = "N10 G0 X100 Y0 Z20\n"
                           "N20 CYC_FEED = 200\n"
                           " CYC_COPY_MENU_ROTATE_VIS = 1\n CYC_COPY_ROTATE = 90\n"
                           " CYC_COPY_MENU_COUNT_VIS = 1\n"
                           " CYC_COPY_COUNTX = 2\n CYC_COPY_COUNTY = 2\n"
                           " CYC_COPY_DIFERENCEX = 10\n CYC_COPY_DIFERENCEY = 30\n"
                           " CYC_COPY_ONLY_PARAM = 0\n CYC_DRILL1_HEIGHTSTART = 2\n"
                           " CYC_DRILL1_HEIGHTSTOP = -5\n CYC_DRILL1_HEIGHTRETURN = 20\n"
                           " CYC_COPY_PART = DRILL1\n CALLCYCLE(CYC_COPY)\n"
                           "N30 M30\n";
  std::vector<std::string> bottoms;
  for (const std::string &line : traceOf("mefi", grid))
    if (llvm::StringRef(line).endswith("Z-5"))
      bottoms.push_back(line.substr(line.find('X')));
  EXPECT_THAT(bottoms, ElementsAre("X100 Y0 Z-5", "X100 Y10 Z-5", "X70 Y10 Z-5", "X70 Y0 Z-5"));
}

/// A lathe's line by its angle from +Z: X is a diameter.
TEST(Trace, AnAngleGivesTheMissingCoordinate) {
  EXPECT_THAT(traceOf("haas-lathe", "G00 X22.525 Z0.\nG01 A110. X50. F0.2\nZ-30.\n"),
              ElementsAre("1 rapid X22.525 Z0", "2 linear X50 Z-5", "3 linear X50 Z-30"));
}

TEST(Trace, ATurningPassReturnsToItsStart) {
  EXPECT_THAT(traceOf("fanuc-0t", "G0 X50. Z60.\nG77 X36. Z20. R-4. F0.2\nG0 X60. Z80.\n"),
              ElementsAre("1 rapid X50 Z60", "2 rapid X28 Z60", "2 linear X36 Z20",
                          "2 linear X50 Z20", "2 rapid X50 Z60", "3 rapid X60 Z80"));
}

/// The levels are those that the manual's sample gives: radii of 27.15, 19.15 and 11.15, and 8.65
/// where the contour ends. Z goes back first, because the contour ends outside the start.
TEST(Trace, RoughingCutsLevelsDownToTheContour) {
  EXPECT_THAT(traceOf("haas-lathe",
                      "G54 G00 X70. Z3.\n"
                      "G71 P10 Q20 U0.3 W0.1 D8. F0.3\n"
                      "N10 G00 X17.\n"
                      "G01 X17. Z0\n"
                      "X28. Z-15.\n"
                      "Z-23.\n"
                      "G02 X44. Z-31. R8.\n"
                      "G01 Z-39.\n"
                      "X70. Z-65.\n"
                      "N20 G00 X74.\n"
                      "M30\n",
                      R"({"dialect": "haas-lathe", "options": {"setting73": 0.5}})"),
              ElementsAre("1 rapid X70 Z3", "2 rapid X70.3 Z3.1", "2 rapid X54.3 Z3.1",
                          "2 linear X54.3 Z-48.9", "2 rapid X55.3 Z-48.4", "2 rapid X55.3 Z3.1",
                          "2 rapid X38.3 Z3.1", "2 linear X38.3 Z-30.316", "2 rapid X39.3 Z-29.816",
                          "2 rapid X39.3 Z3.1", "2 rapid X22.3 Z3.1", "2 linear X22.3 Z-6.718",
                          "2 rapid X23.3 Z-6.218", "2 rapid X23.3 Z3.1", "2 rapid X17.3 Z3.1",
                          "2 linear X17.3 Z0.1", "2 rapid X18.3 Z0.6", "2 rapid X18.3 Z3.1",
                          "2 rapid X17.3 Z3.1", "2 linear X17.3 Z0.1", "2 linear X28.3 Z-14.9",
                          "2 linear X28.3 Z-22.9", "2 arc X44.3 Z-30.9 cw -22.9/44.3 0.25",
                          "2 linear X44.3 Z-38.9", "2 linear X70.3 Z-64.9", "2 rapid X74.3 Z-64.9",
                          "2 rapid X74.3 Z3", "2 rapid X70 Z3", "11 end"));
}

/// The interpreter's motions: down to each level along the path to the contour, the pocket after
/// the first shoulder once the contour before it is cut, then its walls.
TEST(Trace, LinuxCncRoughsAContourAndItsPocket) {
  EXPECT_THAT(
      traceOf("linuxcnc", "o1 sub\ng1 x10 z0\nz-5\ng2 x12 z-7 i2 k0\ng1 x11 z-9\nz-12\nx14\n"
                          "o1 endsub\ng18 g21 g90 f100\ng0 x14 z2\ng71 q1 i2 r0.5\nm2\n"),
      ElementsAre("10 rapid X14 Z2", "11 rapid X14 Z2", "11 rapid X14 Z2", "11 rapid X14 Z2",
                  "11 linear X14 Z-12", "11 rapid X14.5 Z-11.5", "11 rapid X14.5 Z1.5",
                  "11 rapid X14 Z2", "11 rapid X12 Z1", "11 linear X12 Z-7", "11 rapid X12.5 Z-6.5",
                  "11 rapid X12.5 Z0.5", "11 rapid X12 Z1", "11 rapid X10 Z0", "11 linear X10 Z-5",
                  "11 arc X12 Z-7 cw -5/12 0.25", "11 linear X12 Z-7", "11 linear X12 Z-12",
                  "11 rapid X12.5 Z-11.5", "11 rapid X12.5 Z-7.5", "11 linear X12 Z-7",
                  "11 linear X11 Z-9", "11 linear X11 Z-12", "11 linear X14 Z-12", "12 end"));
}

TEST(Trace, LinuxCncFinishesInPassesAtADistance) {
  EXPECT_THAT(traceOf("linuxcnc", "o1 sub\ng1 x10 z0\ng1 z-5\ng1 x12 z-7\no1 endsub\n"
                                  "g18 g21 g90 f100\ng0 x14 z2\ng70 q1 d1 e0 p2\nm2\n"),
              ElementsAre("7 rapid X14 Z2", "8 rapid X14 Z2", "8 rapid X14 Z2", "8 rapid X10.5 Z0",
                          "8 linear X10.5 Z-4.793", "8 linear X12.354 Z-6.646", "8 rapid X14 Z2",
                          "8 rapid X10 Z0", "8 linear X10 Z-5", "8 linear X12 Z-7", "9 end"));
}

/// A contour that turns back stops the interpreter: where the tool is then nobody knows.
TEST(Trace, LinuxCncDoesNotRoughAContourThatTurnsBack) {
  EXPECT_THAT(traceOf("linuxcnc", "o1 sub\ng1 x10 z0\ng1 z-5\ng1 x12 z-2\ng1 x14 z-9\no1 endsub\n"
                                  "g18 g21 g90 f100\ng0 x14 z2\ng71 q1\nm2\n"),
              ElementsAre("8 rapid X14 Z2", "9 rapid", "10 end"));
}

/// Without the setting only the withdrawal between the passes is not known.
TEST(Trace, RoughingWithoutTheSettingKeepsItsLevels) {
  EXPECT_THAT(traceOf("haas-lathe", "G54 G00 X20. Z2.\nG71 P10 Q20 U0. W0. D3. F0.3\n"
                                    "N10 G00 X10.\nG01 Z-5.\nN20 X20.\nM30\n"),
              ElementsAre("1 rapid X20 Z2", "2 rapid X14 Z2", "2 linear X14 Z-5", "2 rapid",
                          "2 rapid Z2", "2 rapid X10 Z2", "2 linear X10 Z-5", "2 rapid",
                          "2 rapid Z2", "2 rapid X10 Z2", "2 linear X10 Z-5", "2 linear X20 Z-5",
                          "2 rapid X20 Z-5", "2 rapid X20 Z2", "6 end"));
}

/// A pocket after a shoulder is cut level by level from above; the tool crosses the shoulder above
/// it. The control runs the contour itself after the cycle.
TEST(Trace, APocketIsRoughedAfterItsShoulder) {
  EXPECT_THAT(
      traceOf("nct-104t", "%O1\nG0 X30 Z2\nG71 U5 R1\nG71 P10 Q20 U0 W0 F0.2\n"
                          "N10 G0 X20 Z2\nG1 Z-10\nX10 Z-15\nZ-20\nN20 X30\nM30\n%\n"),
      ElementsAre("2 rapid X30 Z2", "4 rapid X20 Z2", "4 linear X20 Z-20", "4 rapid X22 Z-19",
                  "4 rapid X22 Z2", "4 rapid X22 Z2", "4 rapid X22 Z-15", "4 linear X10 Z-15",
                  "4 linear X10 Z-20", "4 rapid X12 Z-19", "4 rapid X22 Z-19", "4 rapid X22 Z2",
                  "4 rapid X20 Z2", "4 linear X20 Z-10", "4 linear X10 Z-15", "4 linear X10 Z-20",
                  "4 linear X30 Z-20", "4 rapid X30 Z2", "5 rapid X20 Z2", "6 linear X20 Z-10",
                  "7 linear X10 Z-15", "8 linear X10 Z-20", "9 linear X30 Z-20", "10 end"));
}

TEST(Trace, FacingPassesLieSideBySide) {
  EXPECT_THAT(traceOf("fanuc-0t", "G0 X40. Z2.\nG72 W3. R1.\nG72 P10 Q20 U0 W0 F0.2\n"
                                  "N10 G0 Z-5.\nG1 X20.\nN20 Z2.\nM30\n"),
              ElementsAre("1 rapid X40 Z2", "3 rapid X40 Z-1", "3 linear X20 Z-1", "3 rapid X22 Z0",
                          "3 rapid X40 Z0", "3 rapid X40 Z-4", "3 linear X20 Z-4",
                          "3 rapid X22 Z-3", "3 rapid X40 Z-3", "3 rapid X40 Z-5",
                          "3 linear X20 Z-5", "3 rapid X22 Z-4", "3 rapid X40 Z-4",
                          "3 rapid X40 Z-5", "3 linear X20 Z-5", "3 linear X20 Z2",
                          "3 rapid X40 Z2", "7 end"));
}

/// The stock is divided by the number of passes.
TEST(Trace, AContourIsRepeatedFromFarToNear) {
  EXPECT_THAT(traceOf("nct-104t", "%O1\nG0 X140 Z80\nG73 U14 W14 R3\nG73 P10 Q20 U4 W4 F0.3\n"
                                  "N10 G0 X40 Z64\nG1 Z50\nN20 G0 X200\nM30\n%\n"),
              ElementsAre("2 rapid X140 Z80", "4 rapid X162.667 Z93.333", "4 rapid X62.667 Z77.333",
                          "4 linear X62.667 Z63.333", "4 rapid X222.667 Z63.333",
                          "4 rapid X153.333 Z88.667", "4 rapid X53.333 Z72.667",
                          "4 linear X53.333 Z58.667", "4 rapid X213.333 Z58.667",
                          "4 rapid X144 Z84", "4 rapid X44 Z68", "4 linear X44 Z54",
                          "4 rapid X204 Z54", "4 rapid X140 Z80", "5 rapid X40 Z64",
                          "6 linear X40 Z50", "7 rapid X200 Z50", "8 end"));
}

/// On the Haas the distances are those between the first and the last pass.
TEST(Trace, TheFirstRepeatedContourLiesAsFarAsItsWordsSay) {
  EXPECT_THAT(traceOf("haas-lathe", "G54 G00 X30. Z5.\nG73 P10 Q20 U0.4 W0.1 I3. K2. D3. F0.2\n"
                                    "N10 G00 X10. Z1.\nN20 G01 Z-5.\nM30\n"),
              ElementsAre("1 rapid X30 Z5", "2 rapid X36.4 Z7.1", "2 rapid X16.4 Z3.1",
                          "2 linear X16.4 Z-2.9", "2 rapid X33.4 Z6.1", "2 rapid X13.4 Z2.1",
                          "2 linear X13.4 Z-3.9", "2 rapid X30.4 Z5.1", "2 rapid X10.4 Z1.1",
                          "2 linear X10.4 Z-4.9", "2 rapid X30 Z-4.9", "2 rapid X30 Z5", "5 end"));
}

std::vector<std::string> only(const std::vector<std::string> &lines, llvm::StringRef kind) {
  std::vector<std::string> list;
  for (const std::string &line : lines)
    if (llvm::StringRef(line).contains(kind))
      list.push_back(line);
  return list;
}

/// Depths of first cut times the root of the pass, at least the smallest cut, two finishing passes:
/// the manual's thread of 3.407 depth (its cycle runs Q0.6, least 0.3, allowance 0.05).
TEST(Trace, AThreadIsCutInPassesThatGetSmaller) {
  const auto passes = only(traceOf("nct-104t", "%O1\nS600 M3\nG0 X52 Z10\n"
                                               "G76 R0.05 P020060 Q0.3\n"
                                               "G76 X41.185 Z-55 F5 P3.407 Q0.6\nM30\n%\n"),
                           "thread");
  EXPECT_THAT(passes,
              ElementsAre("5 thread X46.799 Z-55", "5 thread X46.199 Z-55", "5 thread X45.599 Z-55",
                          "5 thread X44.999 Z-55", "5 thread X44.399 Z-55", "5 thread X43.799 Z-55",
                          "5 thread X43.199 Z-55", "5 thread X42.599 Z-55", "5 thread X41.999 Z-55",
                          "5 thread X41.399 Z-55", "5 thread X41.285 Z-55", "5 thread X41.185 Z-55",
                          "5 thread X41.185 Z-55"));
}

/// Micrometres, and a run-out of 1.2 leads taken off the end.
TEST(Trace, AThreadRunsOutBeforeItsEnd) {
  EXPECT_THAT(traceOf("fanuc-0t", "S600 M3\nG0 X30. Z4.\nG78 P011200 Q100 R0.\n"
                                  "G78 X18. Z-20. P1000 Q1000 F2.\nM30\n"),
              ElementsAre("2 rapid X30 Z4", "4 rapid X18 Z4", "4 thread X18 Z-17.6",
                          "4 thread X22.8 Z-20", "4 rapid X30 Z-20", "4 rapid X30 Z4",
                          "4 rapid X18 Z4", "4 thread X18 Z-17.6", "4 thread X22.8 Z-20",
                          "4 rapid X30 Z-20", "4 rapid X30 Z4", "5 end"));
}

/// D times the root of the pass down to what setting 86 leaves for the last one.
TEST(Trace, TheMethodSaysHowAThreadIsCut) {
  const char *settings =
      R"({"dialect": "haas-lathe", "options": {"setting86": 0.1, "setting99": 0.01}})";
  const std::string head = "S600 M3\nG54 G00 X22. Z4.\nG76 X18. Z-20. K1. D0.4 F2. A60 P";
  EXPECT_THAT(only(traceOf("haas-lathe", head + "2\nM30\n", settings), "thread"),
              ElementsAre("3 thread X19.2 Z-20", "3 thread X18.869 Z-20", "3 thread X18.614 Z-20",
                          "3 thread X18.4 Z-20", "3 thread X18.211 Z-20", "3 thread X18.2 Z-20",
                          "3 thread X18 Z-20"));
  EXPECT_THAT(only(traceOf("haas-lathe", head + "4\nM30\n", settings), "thread"),
              ElementsAre("3 thread X19.2 Z-20", "3 thread X18.4 Z-20", "3 thread X18.2 Z-20",
                          "3 thread X18 Z-20"));
}

constexpr const char *endmillOfTen = R"({"dialect": "sinumerik", "tools": {"1": {"radius": 5}}})";

/// From its centre the tool goes along the walls, less its radius; depths of at most so much may be
/// smaller than that.
TEST(Trace, APocketIsItsOutlineAtEachDepth) {
  EXPECT_THAT(traceOf("sinumerik",
                      "G17 G90 T1 M6 D1 S1000 M3\nG0 X0 Y0 Z60\n"
                      "POCKET1(50,0,2,-5,,60,40,8,10,20,0,100,300,3,3,0,0,3,200,2500)\n"
                      "M30\n",
                      endmillOfTen),
              ElementsAre("1 tool 1", "2 rapid X0 Y0 Z60", "3 rapid X10 Y20 Z50",
                          "3 rapid X10 Y20 Z2", "3 linear X10 Y20", "3 linear X35 Y20",
                          "3 linear X35 Y32", "3 arc X32 Y35 ccw 32/32 0.25", "3 linear X-12 Y35",
                          "3 arc X-15 Y32 ccw -12/32 0.25", "3 linear X-15 Y8",
                          "3 arc X-12 Y5 ccw -12/8 0.25", "3 linear X32 Y5",
                          "3 arc X35 Y8 ccw 32/8 0.25", "3 linear X35 Y20", "3 linear X10 Y20",
                          "3 linear X10 Y20 Z-5", "3 linear X35 Y20 Z-5", "3 linear X35 Y32 Z-5",
                          "3 arc X32 Y35 Z-5 ccw 32/32 0.25", "3 linear X-12 Y35 Z-5",
                          "3 arc X-15 Y32 Z-5 ccw -12/32 0.25", "3 linear X-15 Y8 Z-5",
                          "3 arc X-12 Y5 Z-5 ccw -12/8 0.25", "3 linear X32 Y5 Z-5",
                          "3 arc X35 Y8 Z-5 ccw 32/8 0.25", "3 linear X35 Y20 Z-5",
                          "3 linear X10 Y20 Z-5", "3 rapid X10 Y20 Z50", "4 end"));
}

TEST(Trace, WithoutItsRadiusTheToolIsSomewhereInThePocket) {
  EXPECT_THAT(traceOf("sinumerik", "G17 G90 S1000 M3\nG0 X0 Y0 Z60\n"
                                   "POCKET2(50,0,2,-5,,20,7,8,100,300,9,3,0,0,2,200,2500)\nM30\n"),
              ElementsAre("2 rapid X0 Y0 Z60", "3 rapid X7 Y8 Z50", "3 rapid X7 Y8 Z2",
                          "3 linear X7 Y8 Z-5", "3 linear Z-5", "3 linear X7 Y8 Z-5",
                          "3 rapid X7 Y8 Z50", "4 end"));
}

/// A long hole is as wide as the tool; slots lie round a centre, in equal parts of the circle where
/// no angle is given. RAD leads to where they begin.
TEST(Trace, SlotsLieRoundTheirCentre) {
  EXPECT_THAT(traceOf("sinumerik",
                      "G17 G90 T1 M6 D1 S1000 M3\nG0 X0 Y0 Z60\n"
                      "LONGHOLE(50,0,2,-5,,2,30,40,45,20,0,,100,300,6)\nM30\n",
                      endmillOfTen),
              ElementsAre("1 tool 1", "2 rapid X0 Y0 Z60", "3 rapid X75 Y45 Z50",
                          "3 rapid X75 Y45 Z2", "3 linear X75 Y45 Z-5", "3 linear X85 Y45 Z-5",
                          "3 linear X65 Y45 Z-5", "3 linear X85 Y45 Z-5", "3 linear X75 Y45 Z-5",
                          "3 rapid X75 Y45 Z50", "3 rapid X5 Y45 Z50", "3 rapid X5 Y45 Z2",
                          "3 linear X5 Y45 Z-5", "3 linear X-5 Y45 Z-5", "3 linear X15 Y45 Z-5",
                          "3 linear X-5 Y45 Z-5", "3 linear X5 Y45 Z-5", "3 rapid X5 Y45 Z50",
                          "4 end"));
  EXPECT_THAT(traceOf("sinumerik",
                      "G17 G90 T1 M6 D1 S1000 M3\nG0 X0 Y0 Z60\n"
                      "SLOT1(50,0,2,-5,,1,30,16,0,0,20,0,,100,300,6,3,0,0)\nM30\n",
                      endmillOfTen),
              ElementsAre("1 tool 1", "2 rapid X0 Y0 Z60", "3 rapid X35 Y0 Z50",
                          "3 rapid X35 Y0 Z2", "3 linear X35 Y0 Z-5", "3 linear X45 Y0 Z-5",
                          "3 arc X42 Y3 Z-5 ccw 42/0 0.25", "3 linear X28 Y3 Z-5",
                          "3 arc X25 Y0 Z-5 ccw 28/0 0.25", "3 arc X28 Y-3 Z-5 ccw 28/0 0.25",
                          "3 linear X42 Y-3 Z-5", "3 arc X45 Y0 Z-5 ccw 42/0 0.25",
                          "3 linear X35 Y0 Z-5", "3 rapid X35 Y0 Z50", "4 end"));
  // Along the circle: the middle of each is known.
  EXPECT_THAT(only(traceOf("sinumerik",
                           "G17 G90 T1 M6 D1 S1000 M3\nG0 X0 Y0 Z60\n"
                           "SLOT2(50,0,2,-5,,2,60,15,60,60,40,60,180,100,300,6,2,0,0)\nM30\n",
                           endmillOfTen),
                   "3 rapid"),
              ElementsAre("3 rapid X60 Y100 Z50", "3 rapid X60 Y100 Z2", "3 rapid X60 Y100 Z50",
                          "3 rapid X60 Y20 Z50", "3 rapid X60 Y20 Z2", "3 rapid X60 Y20 Z50"));
}

/// In a bore the helix runs inside of the nominal diameter by the tool's radius and the tool ends
/// in the middle; round a pin it runs outside, and the tool ends beside it.
TEST(Trace, AThreadIsMilledOnAHelix) {
  const std::string head = "G17 G90 T1 M6 D1 S1000 M3\nG0 X0 Y0 Z60\n";
  EXPECT_THAT(
      traceOf("sinumerik", head + "CYCLE90(48,40,5,0,,60,50,2,500,2,0,60,50)\nG0 Z100\nM30\n",
              endmillOfTen),
      ElementsAre("1 tool 1", "2 rapid X0 Y0 Z60", "3 rapid X60 Y50 Z48", "3 rapid X60 Y50 Z45",
                  "3 linear X85 Y50 Z40", "3 arc X85 Y50 Z0 cw 60/50 20", "3 linear",
                  "3 rapid X60 Y50", "3 rapid X60 Y50 Z48", "4 rapid X60 Y50 Z100", "5 end"));
  EXPECT_THAT(traceOf("sinumerik",
                      head + "CYCLE90(48,40,5,1,,60,50,2,500,3,1,60,50)\nG0 Z100\nM30\n",
                      endmillOfTen),
              ElementsAre("1 tool 1", "2 rapid X0 Y0 Z60", "3 rapid Z48", "3 rapid Z45",
                          "3 linear X95 Y50 Z40", "3 arc X25 Y50 Z1 ccw 60/50 19.5", "3 linear",
                          "3 rapid", "3 rapid Z48", "4 rapid Z100", "5 end"));
}

/// On the ECS depths are steps of INI from RAP on, and the tool ends over the point.
TEST(Trace, AnIslandIsMilledFromOutside) {
  EXPECT_THAT(traceOf("ecs",
                      "N10 G17 G90 <CFF=CFZ> T1 M6\nN20 S1000 M3 F300\nN30 G0 X0 Y0 Z50\n"
                      "N40 G188 <ENT=-6><RAP=0><RAL=5><DIA=30><ROT=2><SME=2><ANA=0><KFD=0.5>"
                      "<DRA=1><INI=4><ASF=0>\nN50 X40 Y40\nN60 G150 Z50\nN70 M30\n",
                      R"({"dialect": "ecs", "tools": {"1": {"radius": 5}}})"),
              ElementsAre("1 tool 1", "3 rapid X0 Y0 Z50", "5 rapid X40 Y40 Z50", "5 rapid Z50",
                          "5 rapid Z0", "5 linear Z-4", "5 linear X61 Y40 Z-4",
                          "5 arc X61 Y40 Z-4 cw 40/40 1", "5 linear Z-6", "5 linear X61 Y40 Z-6",
                          "5 arc X61 Y40 Z-6 cw 40/40 1", "5 rapid Z5", "5 rapid X40 Y40 Z5",
                          "6 rapid X40 Y40 Z50", "7 end"));
}

/// Finishing leads along the contour itself; where it begins and ends nobody knows.
TEST(Trace, AContourIsMilledLevelByLevel) {
  Written written;
  test::withProgram("sinumerik",
                    {{"PART.MPF", "G17 G90 S1000 M3\nG0 X-40 Y-40 Z50\n"
                                  "CYCLE72(\"KONT\",50,0,2,-6,3,0,0,300,150,12,41,2,15)\nM30\n"},
                     {"KONT.SPF", "G90 G0 X0 Y0\nG1 Y60\nG2 X20 Y80 CR=20\nM17\n"}},
                    "",
                    [&](Project &project, FileUnit &unit) { trace(project, unit, {}, written); });
  EXPECT_THAT(written.lines, ElementsAre("2 rapid X-40 Y-40 Z50", "3 rapid Z2", "3 linear Z-6",
                                         "3 linear X0 Y0 Z-6", "3 linear X0 Y60 Z-6",
                                         "3 arc X20 Y80 Z-6 cw 20/60 0.25", "3 linear Z-6",
                                         "3 rapid Z50", "4 end"));
}

/// The first depth from the reference plane, each next one smaller by so much, none smaller than
/// that; outside the hole the tool waits.
TEST(Trace, PecksGetSmaller) {
  EXPECT_THAT(traceOf("sinumerik", "G17 G90 S1000 M3 F100\nG0 X0 Y0 Z50\n"
                                   "CYCLE83(50,0,2,-24,,-10,,4,1,0.5,1,1)\nM30\n"),
              ElementsAre("2 rapid X0 Y0 Z50", "3 rapid X0 Y0 Z2", "3 linear X0 Y0 Z-10",
                          "3 rapid X0 Y0 Z2", "3 dwell 0.5", "3 rapid X0 Y0", "3 linear X0 Y0 Z-16",
                          "3 rapid X0 Y0 Z2", "3 dwell 0.5", "3 rapid X0 Y0", "3 linear X0 Y0 Z-20",
                          "3 rapid X0 Y0 Z2", "3 dwell 0.5", "3 rapid X0 Y0", "3 linear X0 Y0 Z-24",
                          "3 dwell 1", "3 rapid X0 Y0 Z50", "4 end"));
  EXPECT_THAT(traceOf("sinumerik", "G17 G90 S1000 M3 F100\nG0 X0 Y0 Z50\n"
                                   "CYCLE83(50,0,2,-14,,,10,4,0,0,1,0)\nM30\n"),
              ElementsAre("2 rapid X0 Y0 Z50", "3 rapid X0 Y0 Z2", "3 linear X0 Y0 Z-10",
                          "3 rapid X0 Y0", "3 linear X0 Y0 Z-14", "3 rapid X0 Y0 Z50", "4 end"));
}

/// The rows of a grid are drilled to and fro; the angle turns the grid about its first hole.
TEST(Trace, AGridIsDrilledRowByRow) {
  EXPECT_THAT(traceOf("sinumerik", "G17 G90 S1000 M3 F100\nG0 X0 Y0 Z50\nMCALL CYCLE81(50,0,2,-5)\n"
                                   "CYCLE801(10,20,90,10,30,2,2)\nMCALL\nM30\n"),
              ElementsAre("2 rapid X0 Y0 Z50", "4 rapid X10 Y20 Z50", "4 rapid X10 Y20 Z2",
                          "4 linear X10 Y20 Z-5", "4 rapid X10 Y20 Z50", "4 rapid X10 Y30 Z50",
                          "4 rapid X10 Y30 Z2", "4 linear X10 Y30 Z-5", "4 rapid X10 Y30 Z50",
                          "4 rapid X-20 Y30 Z50", "4 rapid X-20 Y30 Z2", "4 linear X-20 Y30 Z-5",
                          "4 rapid X-20 Y30 Z50", "4 rapid X-20 Y20 Z50", "4 rapid X-20 Y20 Z2",
                          "4 linear X-20 Y20 Z-5", "4 rapid X-20 Y20 Z50", "6 end"));
}

/// However small the cut, the passes end.
TEST(Trace, AMillionPassesAreNotFollowed) {
  const auto lines = traceOf("fanuc-0t", "G0 X50. Z2.\nG73 U.00001 R1.\nG73 P10 Q20 U0 W0 F0.2\n"
                                         "N10 G0 X10.\nG1 Z-5.\nN20 X50.\nM30\n");
  EXPECT_LT(lines.size(), 300000u);
  EXPECT_EQ(lines.back(), "7 end");
}

/// A centre under incremental input, and a ratio without a point, may mean several things.
TEST(Trace, WhatATransformationMayMeanIsNotGuessed) {
  EXPECT_THAT(traceOf("fanuc-0m", "O1\nG90 G17 G0 X10 Y0 Z5\nG51 X0 Y0 Z0 P500\nX20\nG50\n"
                                  "G90 X30 Y0\nM30\n"),
              ElementsAre("2 rapid X10 Y0 Z5", "4 rapid", "6 rapid X30 Y0", "7 end"));
  EXPECT_THAT(traceOf("nct-104m", "%O1\nG90 G17 G0 X10 Y0 Z5\nG91 G68 X5 Y0 R90\nX1\nG69\n"
                                  "G90 X30 Y0 Z5\nM30\n%\n"),
              ElementsAre("2 rapid X10 Y0 Z5", "4 rapid", "6 rapid X30 Y0 Z5", "7 end"));
}

/// After a line whose end only the path knows, a word that is not known stays so.
TEST(Trace, AnUnknownWordIsNotCarriedOver) {
  EXPECT_THAT(traceOf("nct-104t", "%O1\nG0 G18 G90 G42 X18 Z-20\nG1 X14 ,A210 F0.1\nZ-30\n"
                                  "X#500\nM30\n%\n"),
              ElementsAre("2 rapid X18 Z-20", "3 linear X14 Z-23.464", "4 linear X14 Z-30",
                          "5 linear Z-30", "6 end"));
}

TEST(Trace, ACountOfRepeatsBeyondAllMeasureEnds) {
  EXPECT_THAT(traceOf("nct-104m", "%O1\nG90 G17 G0 X0 Y0 Z5\nG91 G99 G81 X1 Z-3 R-2 L999999 F90\n"
                                  "G80 M30\n%\n"),
              testing::Contains("4 end"));
}

/// What only the run decides ends the trace, and says so.
TEST(Trace, AnUnknownConditionEndsIt) {
  EXPECT_THAT(traceOf("fanuc-0m", "O1\nG90 G0 X0 Y0\nIF [#1000 EQ 1] GOTO 10\nX10\nN10 M30\n"),
              ElementsAre("2 rapid X0 Y0", "3 lost: what decides here is not known"));
  EXPECT_THAT(traceOf("fanuc-0m", "O1\nG90 G0 X0 Y0\nM98 P77\nX10\nM30\n"),
              ElementsAre("2 rapid X0 Y0", testing::StartsWith("3 lost")));
}

/// The switch for block skip counts as off: such blocks are executed.
TEST(Trace, SkippedBlocksAreExecuted) {
  EXPECT_THAT(traceOf("fanuc-0m", "O1\nG90 G0 X0 Y0\n/X10\nM30\n"),
              ElementsAre("2 rapid X0 Y0", "3 rapid X10 Y0", "4 end"));
}

/// … of a level, too, that no control has.
TEST(Trace, ALevelOfBlockSkipThatDoesNotExistIsOne) {
  EXPECT_THAT(traceOf("sinumerik", "G90 G0 X0 Y0\n/127 X10\nM30\n"),
              ElementsAre("1 rapid X0 Y0", "2 rapid X10 Y0", "3 end"));
}

/// The contour of the square's corner from inside: the paths beside its lines cross 5 mm before it.
TEST(Trace, WithAKnownRadiusTheToolsCentreIsTraced) {
  const char *tools = R"({"tools": {"1": {"kind": "endmill", "radius": 5}}})";
  const std::string program = "%O1\nG90 G17 G0 X-20 Y-10 Z5\n"
                              "G41 G1 X0 Y0 D1 F100\n"
                              "Y40\n" // an outside corner follows
                              "X30\n" // an inside one
                              "Z2\n"
                              "Y60\n"
                              "G40 X50\nM30\n%\n";
  EXPECT_THAT(traceOf("nct-104m", program, tools),
              ElementsAre("2 rapid X-20 Y-10 Z5", "3 linear X-5 Y0 Z5", "4 linear X-5 Y45 Z5",
                          "5 linear X25 Y45 Z5", "6 linear X25 Y45 Z2", "7 linear X25 Y60 Z2",
                          "8 linear X50 Y60 Z2", "9 end"));
  EXPECT_THAT(traceOf("nct-104m", program),
              ElementsAre("2 rapid X-20 Y-10 Z5", "3 linear X0 Y0 Z5", "4 linear X0 Y40 Z5",
                          "5 linear X30 Y40 Z5", "6 linear X30 Y40 Z2", "7 linear X30 Y60 Z2",
                          "8 linear X50 Y60 Z2", "9 end"));
}

TEST(Trace, SomeControlsGoRoundOutsideCornersInAnArc) {
  EXPECT_THAT(traceOf("sinumerik", "$TC_DP6[1,1]=5\nT1 D1 M6\nG90 G17 G0 X-20 Y-10 Z5\n"
                                   "G41 G1 X0 Y0 F100\n"
                                   "Y40\nX30\n"
                                   "G3 X40 Y50 CR=10\n" // tangent
                                   "G40 G1 X60 Y50\nM30\n"),
              ElementsAre("2 tool 1", "3 rapid X-20 Y-10 Z5", "4 linear X-5 Y0 Z5",
                          "5 linear X-5 Y40 Z5", "5 arc X0 Y45 Z5 cw 0/40 0.25",
                          "6 linear X30 Y45 Z5", "7 arc X35 Y50 Z5 ccw 30/50 0.25",
                          "8 linear X60 Y50 Z5", "9 end"));
}

/// The moves without the lines that they come from.
std::vector<std::string> wayOf(const char *dialect, const std::string &program) {
  std::vector<std::string> way = traceOf(dialect, program);
  for (std::string &line : way)
    line.erase(0, line.find(' ') + 1);
  return way;
}

TEST(TraceLaws, NumbersAndSpacesChangeNothing) {
  EXPECT_EQ(wayOf("fanuc-0m", "O1\nG90G0X0Y0Z5\nG81X10Y5Z-3R1F90\nX20\nG80\nM98P2L2\nM30\n"
                              "O2\nG91G1X5F80\nM99\n"),
            wayOf("fanuc-0m", "O1\nN10 G90 G0 X0. Y0. Z5.\n\nN20 G81 X10. Y5. Z-3. R1. F90.\n"
                              "(HOLE)\nN30 X20.\nN40 G80\nN50 M98 P2 L2\nN60 M30\n"
                              "O2\nN10 G91 G1 X5. F80.\nN20 M99\n"));
}

TEST(TraceLaws, AnInchIsTwentyFivePointFourMillimetres) {
  EXPECT_EQ(wayOf("fanuc-0m", "O1\nG21 G90 G17\nG0 X25.4 Y0. Z50.8\nG1 Z-2.54 F254.\n"
                              "G2 X76.2 Y0. I25.4 J0.\nM30\n"),
            wayOf("fanuc-0m", "O1\nG20 G90 G17\nG0 X1. Y0. Z2.\nG1 Z-.1 F10.\n"
                              "G2 X3. Y0. I1. J0.\nM30\n"));
}

/// The setting says how far the tool goes back to break the chip; at the bottom it leaves the wall.
TEST(Trace, AGrooveIsCutInPecks) {
  EXPECT_THAT(traceOf("haas-lathe", "G54 G00 X40. Z-10.\nG75 X30. Z-13. I3. K3. D0.2 F0.1\nM30\n",
                      R"({"dialect": "haas-lathe", "options": {"setting22": 0.5}})"),
              ElementsAre("1 rapid X40 Z-10", "2 linear X34 Z-10", "2 rapid X35 Z-10",
                          "2 linear X30 Z-10", "2 rapid X30 Z-9.8", "2 rapid X40 Z-9.8",
                          "2 rapid X40 Z-13", "2 linear X34 Z-13", "2 rapid X35 Z-13",
                          "2 linear X30 Z-13", "2 rapid X30 Z-12.8", "2 rapid X40 Z-12.8",
                          "2 rapid X40 Z-10", "3 end"));
}

/// The depth of cut is a length, too, where D is also a number of passes.
TEST(TraceLaws, ADepthOfCutInInchesIsALength) {
  EXPECT_EQ(wayOf("haas-lathe", "G21 G54 G00 X76.2 Z2.54\nG71 P10 Q20 U0. W0. D12.7 F0.254\n"
                                "N10 G00 X25.4\nG01 Z-25.4\nN20 X76.2\nM30\n"),
            wayOf("haas-lathe", "G20 G54 G00 X3. Z.1\nG71 P10 Q20 U0. W0. D.5 F.01\n"
                                "N10 G00 X1.\nG01 Z-1.\nN20 X3.\nM30\n"));
}

TEST(TraceLaws, MirroringTwiceIsNotMirroring) {
  const std::string contour = "G0 X10 Y5\nG1 X30 F100\nG2 X40 Y15 I0 J10\nG0 X0 Y0\n";
  const auto plain = wayOf("sinumerik", "G17 G90 G0 X0 Y0 Z5\n" + contour + "M30\n");
  EXPECT_EQ(plain, wayOf("sinumerik", "G17 G90 G0 X0 Y0 Z5\nMIRROR X0\nAMIRROR X0\n" + contour +
                                          "MIRROR\nM30\n"));
  EXPECT_NE(plain,
            wayOf("sinumerik", "G17 G90 G0 X0 Y0 Z5\nMIRROR X0\n" + contour + "MIRROR\nM30\n"));
}

TEST(TraceLaws, CompensationWithoutARadiusIsNone) {
  const std::string contour = " X0 Y0 D1 F100\nY40\nX30 ,R4\nY60\nG2 X50 Y80 I20 J0\n";
  const std::string begin = "O1\nG90 G17 G21\nG0 X-20 Y-10 Z5\n";
  const char *none = R"({"tools": {"1": {"kind": "endmill", "radius": 0}}})";
  std::vector<std::string> with, without;
  with = traceOf("fanuc-0m", begin + "G41 G1" + contour + "G40 G1 X90\nM30\n", none);
  without = traceOf("fanuc-0m", begin + "G1" + contour + "G1 X90\nM30\n", none);
  EXPECT_EQ(with, without);
}

/// A tool of a micrometre runs where the contour is, to a micrometre and what corners make of it.
TEST(TraceLaws, ASmallRadiusChangesThePathALittle) {
  const std::string program = "O1\nG90 G17 G21\nG0 X-20 Y-10 Z5\nG41 G1 X0 Y0 D1 F100\nY40\n"
                              "G2 X20 Y60 I20 J0\nG1 X60\nG40 X90\nM30\n";
  EXPECT_EQ(traceOf("fanuc-0m", program, R"({"tools": {"1": {"radius": 0.0001}}})"),
            traceOf("fanuc-0m", program, R"({"tools": {"1": {"radius": 0}}})"));
}

TEST(TraceLaws, AWayOfIncrementsIsTheWayOfItsPoints) {
  EXPECT_EQ(
      wayOf("nct-104m", "%O1\nG90 G17 G0 X5 Y5 Z5\nG1 X15 F90\nG3 X25 Y15 I0 J10\nM30\n%\n"),
      wayOf("nct-104m", "%O1\nG90 G17 G0 X5 Y5 Z5\nG91 G1 X10 F90\nG3 X10 Y10 I0 J10\nM30\n%\n"));
}

/// A machine whose offsets are known: G53 and the work offsets are places in one another.
constexpr char knownOffsets[] =
    R"({"dialect": "linuxcnc",
        "offsets": {"G54": {"X": 0, "Y": 0, "Z": 0}, "G55": {"X": 100, "Y": 50, "Z": 0},
                    "G92": {"X": 0, "Y": 0, "Z": 0}, "G28": {"X": 5, "Y": 6, "Z": 70}},
        "tools": {"1": {"length": 30}, "2": {"length": 45}}})";

TEST(Trace, WorkOffsetsAreFollowedWhereTheirPlaceIsKnown) {
  EXPECT_THAT(traceOf("linuxcnc",
                      "G21 G90 G17 G0 X10 Y10 Z0\n"
                      "G55 G0 X0\n"
                      "G53 G0 X0\n"
                      "G10 L20 P2 X7\n"
                      "G0 Y0\n"
                      "G54\n"
                      "G10 L2 P1 R90\n"
                      "G0 X20\n"
                      "M2\n",
                      knownOffsets),
              ElementsAre("1 rapid X10 Y10 Z0", "2 rapid X0 Y-40 Z0", "3 rapid X-100 Y-40 Z0",
                          "5 rapid X7 Y0 Z0", "8 rapid X20 Y0 Z0", "9 end"));
}

TEST(Trace, ShiftsOverTheWorkOffsetComeAndGo) {
  EXPECT_THAT(traceOf("linuxcnc",
                      "G21 G90 G0 X10 Y0 Z0\nG92 X0\nG0 Y1\nG92.2\nG0 Y2\n"
                      "G92.3\nG0 Y3\nG52 X2\nG0 Y4\nG92.1\nG0 Y5\nM2\n",
                      knownOffsets),
              ElementsAre("1 rapid X10 Y0 Z0", "3 rapid X0 Y1 Z0", "5 rapid X10 Y2 Z0",
                          "7 rapid X0 Y3 Z0", "9 rapid X8 Y4 Z0", "11 rapid X10 Y5 Z0", "12 end"));
}

TEST(Trace, LengthsOfToolsMoveTheZeroPoint) {
  EXPECT_THAT(traceOf("linuxcnc",
                      "G21 G90 G0 X0 Y0 Z100\nT1 M6\nG43\nG0 X1\nG43 H2\nG0 X2\n"
                      "G43.1 Z10\nG0 X3\nG43.2 H1\nG0 X4\nG49\nG0 X5\nM2\n",
                      knownOffsets),
              ElementsAre("1 rapid X0 Y0 Z100", "2 tool 1", "4 rapid X1 Y0 Z70",
                          "6 rapid X2 Y0 Z55", "8 rapid X3 Y0 Z90", "10 rapid X4 Y0 Z60",
                          "12 rapid X5 Y0 Z100", "13 end"));
}

/// G10 L1 changes the list only: the next G43 takes what it says.
TEST(Trace, LengthsThatTheProgramGivesCountFromTheNextG43On) {
  EXPECT_THAT(traceOf("linuxcnc",
                      "G21 G90 G0 X0 Y0 Z100\nG43 H1\nG10 L1 P1 Z40\nG0 X1\nG43 H1\nG0 X2\n"
                      "G10 L1 P1 R3\nG43 H1\nG0 X3\nG10 L10 P1 Z0\nG43 H1\nG0 X4\nM2\n",
                      knownOffsets),
              ElementsAre("1 rapid X0 Y0 Z100", "4 rapid X1 Y0 Z70", "6 rapid X2 Y0 Z60",
                          "9 rapid X3 Y0 Z60", "12 rapid X4 Y0 Z0", "13 end"));
}

/// The interpreter reads on in the body of what nothing closes (rs274 of LinuxCNC 2.9).
TEST(Trace, WhatIsNotClosedIsEnteredAllTheSame) {
  EXPECT_THAT(traceOf("linuxcnc", "G21 G90 G0 X0\no1 if [1]\nG0 X1\no2 while [1]\nG0 X2\nM2\n"),
              ElementsAre("1 rapid X0", "3 rapid X1", "5 rapid X2", "6 end"));
}

/// M72 brings back the work offset, and no length where none was in force; so does the end of a
/// subprogram after M73.
TEST(Trace, KeptModesComeBack) {
  EXPECT_THAT(traceOf("linuxcnc",
                      "G21 G90 G54 G0 X0 Y0 Z100\nM70\nG91 G55 G20\nG43 H1\nM72\nG0 X2\n"
                      "M2\n",
                      knownOffsets),
              ElementsAre("1 rapid X0 Y0 Z100", "6 rapid X2 Y0 Z100", "7 end"));
  EXPECT_THAT(traceOf("linuxcnc",
                      "o1 sub\nM73\nG91\nG0 X5\no1 endsub\n"
                      "G21 G90 G54 G0 X1 Y0 Z0\no1 call\nG0 X2\nM2\n",
                      knownOffsets),
              ElementsAre("6 rapid X1 Y0 Z0", "4 rapid X6 Y0 Z0", "8 rapid X2 Y0 Z0", "9 end"));
  EXPECT_THAT(traceOf("linuxcnc",
                      "o1 sub\nM73\nG91\nG0 X5\nM70\no2 call\nM72\nG0 X5\no1 endsub\n"
                      "o2 sub\nG90\no2 endsub\n"
                      "G21 G90 G54 G0 X1 Y0 Z0\no1 call\nG0 X2\nM2\n",
                      knownOffsets),
              ElementsAre("13 rapid X1 Y0 Z0", "4 rapid X6 Y0 Z0", "8 rapid X11 Y0 Z0",
                          "15 rapid X13 Y0 Z0", "16 end")); // M70 took the place of M73's
}

/// As rs274 goes on after them: from where the last pass ends.
TEST(Trace, AfterPassesAlongAContourTheToolIsWhereTheLastOneEnds) {
  const std::string head = "G21 G18 G7 G90 F100\nO200 sub\nG1 X20 Z-5\nG1 Z-20\nG1 X30\n"
                           "O200 endsub\nG0 X40 Z2\n";
  const auto after = [&](const std::string &cycle) {
    return only(traceOf("linuxcnc", head + cycle + "\nG91 G0 X2\nM2\n"), "9 ");
  };
  EXPECT_THAT(after("G71 Q200 X34 Z-1 D0.5 I4 R0.5"), ElementsAre("9 rapid X18 Z-19.5"));
  EXPECT_THAT(after("G70 Q200 X34 Z-1"), ElementsAre("9 rapid X16 Z-20"));
  EXPECT_THAT(after("G70 Q200 X34 Z-1 D[#31]"), ElementsAre("9 rapid")); // nobody knows #31
}

TEST(Trace, StoredPlacesAreOnTheMachine) {
  EXPECT_THAT(traceOf("linuxcnc",
                      "G21 G90 G54 G0 X0 Y0 Z10\nG28 Z20\nG30.1\nG0 X50 Z0\nG30\n"
                      "M2\n",
                      knownOffsets),
              ElementsAre("1 rapid X0 Y0 Z10", "2 rapid X0 Y0 Z20", "2 rapid X0 Y0 Z70",
                          "4 rapid X50 Y0 Z0", "5 rapid X0 Y0 Z70", "6 end"));
}

/// What a program does not know of its machine stays unknown.
TEST(Trace, WithoutAProfileOffsetsAreNotKnown) {
  EXPECT_THAT(traceOf("linuxcnc", "G21 G90 G0 X1 Y1 Z1\nG55\nG0 X2\nG92 Y3\nG0 Z4\nM2\n"),
              ElementsAre("1 rapid X1 Y1 Z1", "3 rapid X2", "5 rapid X2 Y3 Z4", "6 end"));
}

/// The initial level is that of the row, also after another cycle; below R the tool rises.
TEST(Trace, ARowOfCyclesHasOneInitialLevel) {
  EXPECT_THAT(traceOf("linuxcnc", "G21 G90 G17 F100 S500 M3 G0 X0 Y0 Z20\n"
                                  "G99 G81 X1 Y1 Z-3 R2\n"
                                  "G98 G85 X2 Z-3 R4\n"
                                  "G80\n"
                                  "M2\n"),
              ElementsAre("1 rapid X0 Y0 Z20", "2 rapid X1 Y1 Z20", "2 rapid X1 Y1 Z2",
                          "2 linear X1 Y1 Z-3", "2 rapid X1 Y1 Z2", "3 rapid X2 Y1 Z20",
                          "3 rapid X2 Y1 Z4", "3 linear X2 Y1 Z-3", "3 linear X2 Y1 Z4",
                          "3 rapid X2 Y1 Z20", "5 end"));
}

TEST(Trace, CyclesOfOtherPlanesDrillAlongTheirAxis) {
  EXPECT_THAT(traceOf("linuxcnc", "G21 G90 G18 G98 F100 G0 X0 Y20 Z0\n"
                                  "G83 X1 Z2 Y-3 R1 Q3\n"
                                  "M2\n"),
              ElementsAre("1 rapid X0 Y20 Z0", "2 rapid X1 Y20 Z2", "2 rapid X1 Y1 Z2",
                          "2 linear X1 Y-2 Z2", "2 rapid X1 Y1 Z2", "2 rapid X1 Y-1.746 Z2",
                          "2 linear X1 Y-3 Z2", "2 rapid X1 Y20 Z2", "3 end"));
}

TEST(Trace, AThreadIsCutPassByPass) {
  EXPECT_THAT(traceOf("linuxcnc", "G21 G90 G18 S100 M3 G0 X8 Y0 Z5\n"
                                  "G76 P1 Z-2 I-1 J0.3 K0.5 L2 E0.4\n"
                                  "M2\n"),
              ElementsAre("1 rapid X8 Y0 Z5", "2 rapid X8.2 Y0 Z5", "2 rapid X6.7 Y0 Z5",
                          "2 thread X6.7 Y0 Z-1.6", "2 thread X7.2 Y0 Z-2", "2 rapid X8.2 Y0 Z-2",
                          "2 rapid X8 Y0 Z5", "2 rapid X6.5 Y0 Z5", "2 thread X6.5 Y0 Z-1.6",
                          "2 thread X7 Y0 Z-2", "2 rapid X8 Y0 Z-2", "2 rapid X8 Y0 Z-2", "3 end"));
}

TEST(Trace, ACurveThroughControlPointsIsMadeAtItsEnd) {
  EXPECT_THAT(traceOf("linuxcnc", "G21 G90 F100 G0 X0 Y0 Z0\n"
                                  "G5.2 X1 Y2 P1 L3\n"
                                  "X3 Y4 P1\n"
                                  "X5 Y4 P1\n"
                                  "G5.3\n"
                                  "M2\n"),
              ElementsAre("1 rapid X0 Y0 Z0", "5 linear X5 Y4 Z0", "6 end"));
}

TEST(Trace, DiametersDwellsPlacesAndDistances) {
  EXPECT_THAT(traceOf("linuxcnc", "G21 G90 G18 F100 G0 X0 Y0 Z0\n"
                                  "G7 G1 X40\n"
                                  "G8 G4 P1 X30\n"
                                  "G17 @10 ^90\n"
                                  "G91 @5 ^-90\n"
                                  "G90 X[#5420 + 1] Y[#<_x> + 2]\n"
                                  "X--5 Y-SIN[30]\n"
                                  "M2\n"),
              ElementsAre("1 rapid X0 Y0 Z0", "2 linear X20 Y0 Z0", "3 dwell 1",
                          "3 linear X30 Y0 Z0", "4 linear X0 Y10 Z0", "5 linear X15 Y0 Z0",
                          "6 linear X16 Y17 Z0", "7 linear X5 Y-0.5 Z0", "8 end"));
}

/// Round the centre on which the tool is, at each depth; it stays down there.
TEST(Trace, MillsACircularPocketWhereTheToolIs) {
  const std::string tool = R"({"tools": {"1": {"kind": "endmill", "radius": 5}}})";
  EXPECT_THAT(traceOf("haas-mill",
                      "O1\nG21 G90 G54 T1 M6\nG0 X10. Y20. Z2.\n"
                      "G13 I20. Z-3. D1 F200.\nG0 Z50.\nM30\n",
                      tool),
              ElementsAre("2 tool 1", "3 rapid X10 Y20 Z2", "4 linear X10 Y20 Z-3",
                          "4 linear X25 Y20 Z-3", "4 arc X25 Y20 Z-3 ccw 10/20 1",
                          "4 linear X10 Y20 Z-3", "5 rapid X10 Y20 Z50", "6 end"));
  EXPECT_THAT(traceOf("haas-mill",
                      "O1\nG21 G90 G54 T1 M6\nG0 X0. Y0. Z1.\n"
                      "G91 G12 X10. Y0. I6. K20. Q5. Z-1. L2 D1 F200.\nG90 G0 Z50.\nM30\n",
                      tool),
              ElementsAre("2 tool 1", "3 rapid X0 Y0 Z1", "4 rapid X10 Y0 Z1", "4 linear X10 Y0 Z0",
                          "4 linear X25 Y0 Z0", "4 arc X25 Y0 Z0 cw 10/0 1", "4 linear X10 Y0 Z0",
                          "4 linear X10 Y0 Z-1", "4 linear X25 Y0 Z-1",
                          "4 arc X25 Y0 Z-1 cw 10/0 1", "4 linear X10 Y0 Z-1", "5 rapid X10 Y0 Z50",
                          "6 end"));
}

/// Of a pocket by a program of its own the depths are said, not its paths nor its end.
TEST(Trace, KnowsTheDepthsOfAPocketByAProgram) {
  std::vector<std::string> levels;
  for (const std::string &line :
       traceOf("haas-mill", "O1\nG21 G90 G54 T1 M6\nG0 X0. Y0. Z50.\n"
                            "G150 P100 X5. Y5. I2. K0.5 Q1. R1. Z-2.5 D1 F100.\nG0 X0.\nM30\n"
                            "O100\nG1 X9. Y0.\nY9.\nX0.\nY0.\nX9.\nM99\n"))
    if (llvm::StringRef(line).contains("linear Z") || line.front() == '5')
      levels.push_back(line);
  EXPECT_THAT(levels, ElementsAre("4 linear Z0", "4 linear Z0", "4 linear Z-1", "4 linear Z-1",
                                  "4 linear Z-2", "4 linear Z-2", "4 linear Z-2.5",
                                  "4 linear Z-2.5", "5 rapid X0"));
}

} // namespace
} // namespace ncvet
