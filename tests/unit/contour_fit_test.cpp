// Which tools fit beside a contour, and how far elements are apart.
#include "interp/geometry/contour_distance.h"
#include "interp/geometry/contour_fit.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ncvet {
namespace {

ContourElement line(double fromX, double fromY, double toX, double toY) {
  return {{fromX, fromY}, {toX, toY}, {fromX, fromY}, false, false};
}
ContourElement arc(Vector from, Vector to, Vector centre, bool clockwise) {
  return {from, to, centre, true, clockwise};
}

/// Straight lines from point to point.
std::vector<ContourElement> polygon(std::initializer_list<Vector> points) {
  std::vector<ContourElement> contour;
  for (const Vector *point = points.begin() + 1; point != points.end(); ++point)
    contour.push_back(line(point[-1].x(), point[-1].y(), point->x(), point->y()));
  return contour;
}

TEST(ContourFit, AnInsideCornerTakesTheRadiusOffBothLines) {
  const CornerFit fit = fitCorner(line(0, 0, 20, 0), line(20, 0, 20, 30), 4);
  EXPECT_EQ(fit.kind, CornerFit::Kind::Inside);
  EXPECT_NEAR(fit.ofFirst, 4, 1e-9);
  EXPECT_NEAR(fit.ofSecond, 4, 1e-9);
  EXPECT_NEAR((fit.meet - Vector(16, 4)).norm(), 0, 1e-9);
}

TEST(ContourFit, TheSameCornerIsAnOutsideOneForAToolOnTheOtherSide) {
  const CornerFit fit = fitCorner(line(0, 0, 20, 0), line(20, 0, 20, 30), -4);
  EXPECT_EQ(fit.kind, CornerFit::Kind::Outside);
  EXPECT_NEAR(fit.gain, 4, 1e-9);
}

TEST(ContourFit, TangentElementsJoin) {
  const CornerFit fit = fitCorner(line(0, 0, 20, 0), arc({20, 0}, {30, 10}, {20, 10}, false), 4);
  EXPECT_EQ(fit.kind, CornerFit::Kind::Smooth);
  EXPECT_NEAR((fit.meet - Vector(20, 4)).norm(), 0, 1e-9);
}

TEST(ContourFit, WhereALineMeetsAnArcInsideTheyCross) {
  // Down to the bottom of a half circle whose centre lies on the corner's height.
  const ContourElement down = line(0, 20, 0, 0), bowl = arc({0, 0}, {20, 0}, {10, 0}, false);
  EXPECT_EQ(fitCorner(down, bowl, 3).kind, CornerFit::Kind::Smooth);
  const ContourElement slope = line(-10, 10, 0, 0);
  const CornerFit fit = fitCorner(slope, arc({0, 0}, {14, 14}, {0, 14}, false), 3);
  EXPECT_EQ(fit.kind, CornerFit::Kind::Inside);
  EXPECT_NEAR(fit.meet.x() + fit.meet.y(), 3 * std::sqrt(2.0), 1e-9); // beside the slope
  EXPECT_NEAR((fit.meet - Vector(0, 14)).norm(), 11, 1e-9);           // beside the arc
}

/// The step of the NCT manual's interference alarm: 5 mm wide and deep (its lines 3597-3645).
TEST(ContourFit, AStepThatIsNarrowerThanTheToolDoesNotFit) {
  const auto step = polygon({{0, 0}, {20, 0}, {20, -5}, {25, -5}, {25, 0}});
  const auto judge = [&](size_t i, double left) {
    return misfit(step[i], {&step[i - 1], i + 1 < step.size() ? &step[i + 1] : nullptr}, left,
                  false);
  };
  EXPECT_EQ(judge(2, 2), Misfit::Fits);
  EXPECT_EQ(judge(2, 10), Misfit::Element);
  EXPECT_EQ(judge(1, 10), Misfit::Fits) << "round the corner above it there is room to go on";
  EXPECT_NEAR(*largestFit(step[2], {&step[1], &step[3]}, true, false), 2.5, 0.01);
}

TEST(ContourFit, AStepIsAlarmedAllTheSameWhereTheControlChecksDirections) {
  const auto step = polygon({{0, 0}, {20, 0}, {20, -5}, {60, -5}});
  EXPECT_EQ(misfit(step[1], {&step[0], &step[2]}, 10, false), Misfit::Fits);
  EXPECT_EQ(misfit(step[1], {&step[0], &step[2]}, 10, true), Misfit::Element);
}

TEST(ContourFit, AnInsideArcIsAsLargeAsTheToolAtLeast) {
  const ContourElement in = arc({0, 0}, {4, 4}, {0, 4}, false);
  EXPECT_EQ(misfit(in, Neighbours(), 4, false), Misfit::Fits);
  EXPECT_EQ(misfit(in, Neighbours(), 4.1, false), Misfit::Arc);
  EXPECT_EQ(misfit(in, Neighbours(), -50, false), Misfit::Fits) << "outside of it any tool runs";
}

TEST(ContourFit, OfAPocketTheSmallestArcCounts) {
  std::vector<ContourElement> pocket = {
      line(20, 0, 34, 0),  arc({34, 0}, {40, 6}, {34, 6}, false),
      line(40, 6, 40, 26), arc({40, 26}, {36, 30}, {36, 26}, false),
      line(36, 30, 0, 30), line(0, 30, 0, 0),
      line(0, 0, 20, 0)};
  EXPECT_NEAR(*largestFit(pocket, true), 4, 0.01);
  EXPECT_FALSE(largestFit(polygon({{0, 0}, {50, 0}, {50, 50}, {0, 50}, {0, 0}}), false))
      << "any tool runs round a square";
}

/// The neck of a keyhole is 8 mm wide; all its corners have room for more.
TEST(ContourFit, ANeckBetweenElementsThatAreNoNeighboursCounts) {
  const auto keyhole = polygon({{-20, 60},
                                {-20, 40},
                                {0, 40},
                                {0, 10},
                                {-10, 10},
                                {-10, -10},
                                {18, -10},
                                {18, 10},
                                {8, 10},
                                {8, 40},
                                {28, 40},
                                {28, 60}});
  EXPECT_NEAR(*largestFit(keyhole, true), 4, 0.01);
}

TEST(ContourDistance, LinesAndArcs) {
  EXPECT_NEAR(distanceBetween(line(0, 0, 10, 0), line(0, 3, 10, 3)), 3, 1e-12);
  EXPECT_EQ(distanceBetween(line(0, 0, 10, 0), line(5, -5, 5, 5)), 0);
  EXPECT_NEAR(distanceBetween(line(0, 0, 10, 0), line(13, 4, 20, 4)), 5, 1e-12);
  const ContourElement half = arc({5, 0}, {-5, 0}, {0, 0}, false); // over the top
  EXPECT_NEAR(distanceBetween(half, line(-10, 8, 10, 8)), 3, 1e-12);
  EXPECT_EQ(distanceBetween(half, line(0, 0, 0, 10)), 0);
  EXPECT_NEAR(distanceBetween(half, line(-10, -8, 10, -8)), 8, 1e-12) << "its ends are nearest";
  EXPECT_EQ(distanceBetween(half, arc({12, 0}, {2, 0}, {7, 0}, false)), 0);
  EXPECT_NEAR(distanceBetween(half, arc({-2, 12}, {2, 12}, {0, 12}, false)), 5, 1e-12);
}

} // namespace
} // namespace ncvet
