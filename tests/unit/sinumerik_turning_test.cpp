// Turning on a Sinumerik: what X means, and the cycles of a lathe.
#include "tests/support/written_trace.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ncvet {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

using test::traceOf;
using test::Written;

std::vector<std::string> traceOf(const std::vector<test::ProgramFile> &files) {
  Written written;
  test::withProgram("sinumerik", files, "",
                    [&](Project &project, FileUnit &unit) { trace(project, unit, {}, written); });
  return written.lines;
}

/// Coordinates are radii where the program programs diameters; centres as distances stay radii,
/// centres as coordinates do not.
TEST(SinumerikTurning, DiametersBecomeRadii) {
  EXPECT_THAT(traceOf("sinumerik", "G18 G90 G95 DIAMON\n"
                                   "G0 X42 Z2\n"
                                   "G1 X40 Z0 F0.2\n"
                                   "G3 X50 Z-5 I0 K-5\n"
                                   "G1 X=IC(10) Z-10\n"
                                   "G2 X70 Z-15 I=AC(70) K=AC(-10)\n"
                                   "G3 X80 Z-20 CR=5\n"),
              ElementsAre("2 rapid X21 Z2", "3 linear X20 Z0", "4 arc X25 Z-5 ccw -5/20 0.25",
                          "5 linear X30 Z-10", "6 arc X35 Z-15 cw -10/35 0.25",
                          "7 arc X40 Z-20 ccw -20/35 0.25"));
}

TEST(SinumerikTurning, Diam90LeavesIncrementsAsRadii) {
  EXPECT_THAT(traceOf("sinumerik", "G18 G90 DIAM90\n"
                                   "G0 X40 Z0\n"
                                   "X=IC(5)\n"
                                   "G91 X5\n"
                                   "G90 X20\n"
                                   "DIAMOF\n"
                                   "X20\n"),
              ElementsAre("2 rapid X20 Z0", "3 rapid X25 Z0", "4 rapid X30 Z0", "5 rapid X10 Z0",
                          "7 rapid X20 Z0"));
}

/// A shift is never a diameter.
TEST(SinumerikTurning, AShiftIsARadius) {
  EXPECT_THAT(traceOf("sinumerik", "G18 G90 DIAMON\nTRANS X10\nG0 X40 Z0\n"),
              ElementsAre("3 rapid X30 Z0"));
}

/// Degressive: each of the four cuts takes the same area, then the allowance, then an idle pass.
TEST(SinumerikTurning, AThreadIsCutPassByPass) {
  const auto moves = traceOf("sinumerik", "G18 G90 G95 DIAMON S500 M3\n"
                                          "G0 X60 Z10\n"
                                          "CYCLE97(2,,0,-30,42,42,5,2,1.3,0.1,0,0,4,1,3,1)\n"
                                          "G0 X60 Z10\n");
  std::vector<std::string> passes;
  for (const std::string &line : moves)
    if (line.find("thread") != std::string::npos)
      passes.push_back(line);
  EXPECT_THAT(passes,
              ElementsAre("3 thread X20.4 Z-32", "3 thread X20.151 Z-32", "3 thread X19.961 Z-32",
                          "3 thread X19.8 Z-32", "3 thread X19.7 Z-32", "3 thread X19.7 Z-32"));
  ASSERT_GE(moves.size(), 3u);
  EXPECT_EQ(moves[1], "3 rapid Z5") << "the run-in lies before the thread";
  EXPECT_EQ(moves[2], "3 rapid X20.4 Z5");
  EXPECT_EQ(moves.back(), "4 rapid X30 Z10");
}

/// Constant cuts in a bore: the thread grows outwards from the core's diameter.
TEST(SinumerikTurning, AThreadInABoreGrowsOutwards) {
  std::vector<std::string> passes;
  for (const std::string &line :
       traceOf("sinumerik", "G18 G90 G95 DIAMON S500 M3\nG0 X30 Z10\n"
                            "CYCLE97(2,,0,-20,38,38,4,2,1.2,0,0,0,3,0,2,1)\n"))
    if (line.find("thread") != std::string::npos)
      passes.push_back(line);
  EXPECT_THAT(passes,
              ElementsAre("3 thread X19.4 Z-22", "3 thread X19.8 Z-22", "3 thread X20.2 Z-22"));
}

TEST(SinumerikTurning, AChainOfThreadsLeadsThroughItsPoints) {
  EXPECT_THAT(traceOf("sinumerik", "G18 G90 G95 DIAMON S500 M3\nG0 X60 Z10\n"
                                   "CYCLE98(0,30,-30,30,-60,36,-80,50,10,10,0.92,0,0,0,1,0,1.5,2,"
                                   "2,1,1)\n"),
              ElementsAre("2 rapid X30 Z10", "3 rapid Z10", "3 rapid X14.08 Z10",
                          "3 thread X14.08 Z-30", "3 thread X17.08 Z-60", "3 thread Z-90",
                          "3 rapid Z-90", "3 rapid Z10"));
}

/// How a contour is roughed nobody states; finishing goes along it.
TEST(SinumerikTurning, StockRemovalFinishesAlongItsContour) {
  EXPECT_THAT(traceOf({{"PART.MPF", "G18 G90 G95 DIAMON S500 M3\n"
                                    "G0 X100 Z10\n"
                                    "CYCLE95(\"SHAFT\",2,0.1,0.1,,0.3,0.2,0.15,9,,,1)\n"
                                    "G0 X100 Z10\n"
                                    "M30\n"},
                       {"SHAFT.SPF", "G1 X20 Z0\nZ-20\nX40 Z-30\nM17\n"}}),
              ElementsAre("2 rapid X50 Z10", "3 rapid", "3 linear", "3 linear X10 Z0",
                          "3 linear X10 Z-20", "3 linear X20 Z-30", "3 rapid", "4 rapid X50 Z10",
                          "5 end"));
}

} // namespace
} // namespace ncvet
