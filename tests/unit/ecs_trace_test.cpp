// Where ECS programs lead whose coordinates are turned, mirrored, moved or given by an angle. The
// values are those of the manual's definitions.
#include "tests/support/written_trace.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ncvet {
namespace {

using testing::ElementsAre;

/// The points of `program` after a start at X0 Y0 Z50, with the number of its line from 1.
std::vector<std::string> pointsOf(const std::string &program) {
  std::vector<std::string> lines;
  constexpr unsigned head = 4;
  for (const std::string &line : test::traceOf("ecs", "%\n"
                                                      "N1 G16XYZ+ <CFF=CFZ>\n"
                                                      "N2 T1 M6\n"
                                                      "N3 G0 X0 Y0 Z50 S1000 F200 M3\n" +
                                                          program)) {
    const auto [number, rest] = llvm::StringRef(line).split(' ');
    unsigned at = 0;
    if (!number.getAsInteger(10, at) && at > head)
      lines.push_back((llvm::Twine(at - head) + " " + rest).str());
  }
  return lines;
}

/// Manual, lines 1240 to 1252.
TEST(EcsTrace, MirrorsAxesOneByOne) {
  EXPECT_THAT(pointsOf("N10 <MIR:ON;X>\nN11 X10 Y20\nN12 <MIR:ON;Y>\nN13 X10 Y20\n"
                       "N14 <MIR:OFF;X>\nN15 X10 Y20\nN16 <MIR:OFF>\nN17 X10 Y20\n"),
              ElementsAre("2 rapid X-10 Y20 Z50", "4 rapid X-10 Y-20 Z50", "6 rapid X10 Y-20 Z50",
                          "8 rapid X10 Y20 Z50"));
}

/// Manual, lines 1611 to 1651: moved first, then turned counter-clockwise.
TEST(EcsTrace, MovesAndTurnsTheOriginByG58) {
  EXPECT_THAT(pointsOf("N20 G58 X30 Y80 RC30\nN21 X10 Y0\nN22 G58\nN23 X10 Y0\n"),
              ElementsAre("2 rapid X38.66 Y85 Z50", "4 rapid X10 Y0 Z50"));
}

/// How G58 and the mirror lie in each other the manual leaves open: nothing is known of the places.
TEST(EcsTrace, LeavesAMirrorUnderG58Open) {
  EXPECT_THAT(pointsOf("N20 <MIR:ON;X>\nN21 G58 X30 Y80 RC0\nN22 X10 Y0\n"),
              ElementsAre("3 rapid"));
}

/// Manual, lines 1582 to 1609: absolute or from the offset in force, each axis by itself.
TEST(EcsTrace, MovesTheOriginByG59) {
  EXPECT_THAT(pointsOf("N30 G59 X5 Y5\nN31 X0 Y0\nN32 G59 DX5\nN33 X0 Y0\nN34 G59 Y0\nN35 X1 Y0\n"),
              ElementsAre("2 rapid X5 Y5 Z50", "4 rapid X10 Y5 Z50", "6 rapid X11 Y0 Z50"));
}

/// Another origin of the table is written: the one in force stays.
TEST(EcsTrace, KeepsTheOriginWhenAnotherIsWritten) {
  EXPECT_THAT(pointsOf("N30 G59 N3 X100 Y0 Z0\nN31 X7 Y7 Z50\n"), ElementsAre("2 rapid X7 Y7 Z50"));
}

/// Manual, lines 2072 to 2112: pole, angle and radius, also in the blocks after.
TEST(EcsTrace, FollowsPolarMoves) {
  EXPECT_THAT(pointsOf("N40 G10 X10 Y10 A30 B50\nN41 X0 Y0 A0 B20\n"
                       "N42 G13 I0 J0 X0 Y0 A90 B20 F200\nN43 G12 I0 J0 X0 Y0 A0 B20\n"
                       "N44 G11 X0 Y0 A180 B5\nN45 G1 X1 Y2\n"),
              ElementsAre("1 rapid X53.301 Y35 Z50", "2 rapid X20 Y0 Z50",
                          "3 arc X0 Y20 Z50 ccw 0/0 0.25", "4 arc X20 Y0 Z50 cw 0/0 0.25",
                          "5 linear X-5 Y0 Z50", "6 linear X1 Y2 Z50"));
}

/// The matrix of the manual's example, lines 3920 to 3924, and others with all twelve numbers.
TEST(EcsTrace, AppliesAMatrix) {
  EXPECT_THAT(pointsOf("N50 <MAT:TRASL; 1; 0; 0; 230; 0; 1; 0; 150; 0; 0; 1; 0>\n"
                       "N51 <MAT:QUART; 0; -1; 0; 0; 1; 0; 0; 0; 0; 0; 1; 0>\n"
                       "N52 <MTX:X;Y;Z>\nN53 <TCT:ON;TRASL>\nN54 X1 Y2 Z3\nN55 <TCT:OFF>\n"
                       "N56 <TCT:ON;QUART>\nN57 X10 Y0 Z3\nN58 <TCT:OFF>\nN59 X1 Y2 Z3\n"),
              ElementsAre("5 rapid X231 Y152 Z3", "8 rapid X0 Y10 Z3", "10 rapid X1 Y2 Z3"));
}

/// Along other axes than X, Y and Z it is not followed.
TEST(EcsTrace, DoesNotGuessAMatrixOfOtherAxes) {
  EXPECT_THAT(pointsOf("N52 <MTX:Z;X;Y>\nN53 L<ROTZ> <ANR=90>\nN54 X1 Y2 Z3\n"),
              ElementsAre("3 rapid"));
}

/// Manual, lines 3926 to 4047.
TEST(EcsTrace, AppliesTheMatricesOfTheLibrary) {
  EXPECT_THAT(pointsOf("N60 <MTX:X;Y;Z> <%CON=2>\n"
                       "N61 L<TRANS> <DTX=180> <DTY=120> <DTZ=0> <%NRP=3>\nN62 X1 Y1\n"
                       "N63 <TCT:OFF> <%CON=1>\n"
                       "N64 L<ROTZ> <ANR=90>\nN65 X10 Y0\nN66 <TCT:OFF>\n"
                       "N67 L<ROTRAS> <ANR=35> <DTX=215> <DTY=125> <XCE=0> <YCE=0> <%NRP=1>\n"
                       "N68 X200 Y100\nN69 <TCT:OFF>\n"
                       "N70 L<SCALE> <SCA=0.8>\nN71 X10 Y20\nN72 <TCT:OFF>\n"),
              ElementsAre("3 rapid X361 Y241 Z50", "6 rapid X0 Y10 Z50",
                          // 200 cos 35 - 100 sin 35 + 215, 200 sin 35 + 100 cos 35 + 125
                          "9 rapid X321.473 Y321.63 Z50", "12 rapid X8 Y16 Z50"));
}

/// Manual, line 3870: a dynamic matrix transforms as a static one does. With what the head does
/// beside a tilted plane the places are not known. On a cylinder they are those of its surface laid
/// flat (4074 to 4099): before it and after it they are others.
TEST(EcsTrace, AppliesADynamicMatrix) {
  EXPECT_THAT(pointsOf("N60 <MAT:QUART; 0; -1; 0; 0; 1; 0; 0; 0; 0; 0; 1; 0>\n"
                       "N61 <DMX:X;Y;Z>\nN62 <DCT:ON;QUART>\nN63 X10 Y0\nN64 <DCT:OFF>\n"
                       "N65 X1 Y2 Z3\nN66 L<DROTY> <ANR=90>\nN67 X10 Y5 Z1\nN68 <DCT:OFF>\n"
                       "N69 L<TRACYL> <DIA=100>\nN70 X1 Y2 Z3\nN71 Y5\nN72 <DCT:OFF>\nN73 X1\n"),
              ElementsAre("4 rapid X0 Y10 Z50", "6 rapid X1 Y2 Z3", "8 rapid", "11 rapid X1 Y2 Z3",
                          "12 rapid X1 Y5 Z3", "14 rapid X1"));
}

/// In which order it turns about several axes the manual does not say.
TEST(EcsTrace, TurnsAboutOneOfThreeAxes) {
  EXPECT_THAT(pointsOf("N60 <MTX:X;Y;Z>\nN61 L<ROTXYZ> <ANR=0> <AN2=0> <AN3=90>\nN62 X10 Y0 Z3\n"
                       "N63 <TCT:OFF>\nN64 L<ROTXYZ> <ANR=10> <AN2=20> <AN3=0>\nN65 X1 Y2 Z3\n"
                       "N66 <TCT:OFF>\n"),
              ElementsAre("3 rapid X0 Y10 Z3", "6 rapid"));
}

/// Manual, lines 2463 to 2498: each peck is smaller by IND, none is smaller than it, and the tool
/// comes out to RAP; with TIM all are alike and it stays in the hole.
TEST(EcsTrace, PecksByTheWordsOfTheCycle) {
  EXPECT_THAT(pointsOf("N10 G83 <ENT=-20> <RAP=2> <RAL=10> <INI=10> <IND=3>\nN11 X5 Y5\n"),
              ElementsAre("2 rapid X5 Y5 Z50", "2 rapid X5 Y5 Z2", "2 linear X5 Y5 Z-8",
                          "2 rapid X5 Y5 Z2", "2 rapid X5 Y5", "2 linear X5 Y5 Z-15",
                          "2 rapid X5 Y5 Z2", "2 rapid X5 Y5", "2 linear X5 Y5 Z-19",
                          "2 rapid X5 Y5 Z2", "2 rapid X5 Y5", "2 linear X5 Y5 Z-20",
                          "2 rapid X5 Y5 Z10"));
  EXPECT_THAT(pointsOf("N10 G83 <ENT=-20> <RAP=2> <RAL=10> <INI=10> <IND=3> <TIM=1>\n"
                       "N11 X5 Y5\n"),
              ElementsAre("2 rapid X5 Y5 Z50", "2 rapid X5 Y5 Z2", "2 linear X5 Y5 Z-8",
                          "2 rapid X5 Y5", "2 linear X5 Y5 Z-18", "2 rapid X5 Y5",
                          "2 linear X5 Y5 Z-20", "2 dwell 1", "2 rapid X5 Y5 Z10"));
}

/// Manual, lines 3047 to 3125 and 3286 to 3424: profiles are recorded, and cut when the start code
/// comes; of the heights is known what the words say, of the path between them nothing.
TEST(EcsTrace, CutsRecordedProfilesAtTheirHeights) {
  const std::string square = "N20 G1 G42 X20 Y0\nN21 Y20\nN22 X-20\nN23 Y-20\nN24 X20\nN25 Y0\n"
                             "N26 G40 X0 Y0\n";
  EXPECT_THAT(pointsOf("N10 G777 <QFO=20> <QIN=40> <PPA=8> <QPO=50> <KPE=0> <DRA:0>\n"
                       "N11 G701 <XAT=0> <YAT=0>\n" +
                       square + "N30 G778\nN31 G0 Z100\n"),
              ElementsAre("10 rapid", "10 rapid Z42", "10 linear Z32", "10 linear Z32",
                          "10 linear Z24", "10 linear Z24", "10 linear Z20", "10 linear Z20",
                          "10 rapid", "11 rapid Z100"));
  EXPECT_THAT(pointsOf("N10 G0 X0 Y0\nN11 G726 <QIN=10> <DPA=3> <DQS=3> <DRA:0>\n" + square +
                       "N30 G727 <QFO=5>\n" + square + "N40 G728\nN41 G0 Z50\n"),
              ElementsAre("1 rapid X0 Y0 Z50", "18 rapid X0 Y0 Z13", "18 linear X0 Y0 Z10",
                          "18 linear", "19 rapid Z50"));
  EXPECT_THAT(
      pointsOf("N10 G722 I0 J0 <RIN=40> <RFI=20> <QIN=0> <QFI=-10> <DPA=2>\n"
               "N11 G0 Z50\n"),
      ElementsAre("1 rapid Z50", "1 rapid Z0", "1 linear Z0", "1 linear Z-10", "2 rapid Z50"));
}

/// Manual, lines 3638 to 3731: the cycle that is armed runs at each place.
TEST(EcsTrace, DrillsAtThePlacesOfAPattern) {
  const std::string arm = "N80 G81 <ENT=-5> <RAP=2> <RAL=10>\n";
  const auto placesOf = [&](const std::string &pattern) {
    std::vector<std::string> bottoms;
    for (const std::string &line : pointsOf(arm + pattern))
      if (llvm::StringRef(line).contains("linear"))
        bottoms.push_back(line);
    return bottoms;
  };
  EXPECT_THAT(placesOf("N81 L<FORFLA> I5 J0 <%NHL=4> <ARC=0> <RDF=50> <ANA=0>\nN82 G80 Z100\n"),
              ElementsAre("2 linear X55 Y0 Z-5", "2 linear X5 Y50 Z-5", "2 linear X-45 Y0 Z-5",
                          "2 linear X5 Y-50 Z-5"));
  EXPECT_THAT(
      placesOf("N81 L<FORFLA> X20 Y0 I0 J0 <%NHL=3> <ARC=0> <RDF=0> <AIN=180>\nN82 G80 Z100\n"),
      ElementsAre("2 linear X20 Y0 Z-5", "2 linear X0 Y20 Z-5", "2 linear X-20 Y0 Z-5"));
  EXPECT_THAT(placesOf("N81 L<FORMAT> X1 Y2 <%NHL=3> <%NRG=0> <PXL=10> <PYL=5>\nN82 G80 Z100\n"),
              ElementsAre("2 linear X1 Y2 Z-5", "2 linear X11 Y7 Z-5", "2 linear X21 Y12 Z-5"));
  const std::string rows = "N81 L<FORMAT> X10 Y20 <%NHL=2> <%NRG=2> <PXL=10> <PYL=0> <PXR=1> ";
  EXPECT_THAT(placesOf(rows + "<PYR=20>\nN82 G80 Z100\n"),
              ElementsAre("2 linear X10 Y20 Z-5", "2 linear X20 Y20 Z-5", "2 linear X11 Y40 Z-5",
                          "2 linear X21 Y40 Z-5"));
  // Where the second row lies is not said.
  EXPECT_THAT(placesOf(rows + "\nN82 G80 Z100\n"),
              ElementsAre("2 linear X10 Y20 Z-5", "2 linear X20 Y20 Z-5", "2 linear X11 Z-5",
                          "2 linear X21 Z-5"));
  // Nor how many holes.
  EXPECT_THAT(placesOf("N81 L<FORMAT> X1 Y2 <%NRG=0> <PXL=10> <PYL=5>\nN82 G80 Z100\n"),
              ElementsAre("2 linear Z-5"));
}

} // namespace
} // namespace ncvet
