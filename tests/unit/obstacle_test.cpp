// Paths through the boxes of a machine profile.
#include "interp/geometry/obstacle.h"

#include <gtest/gtest.h>

namespace ncvet {
namespace {

Place at(double x, double y, double z) {
  Place place;
  place[0] = Interval::exactly(x);
  place[1] = Interval::exactly(y);
  place[2] = Interval::exactly(z);
  return place;
}

/// 40 mm wide, 20 mm deep, 15 mm high.
Stock clamp() {
  Stock box;
  box.min = {10, 0, std::nullopt};
  box.max = {50, 20, 15};
  return box;
}

TEST(Obstacle, LiesInTheWay) {
  EXPECT_EQ(leadsThrough(clamp(), at(0, 10, 5), at(100, 10, 5)), Truth::Yes);
  EXPECT_EQ(leadsThrough(clamp(), at(30, 10, 50), at(30, 10, 5)), Truth::Yes);
  EXPECT_EQ(leadsThrough(clamp(), at(0, -5, 5), at(20, 15, 5)), Truth::Yes);
}

TEST(Obstacle, IsPassedAboveBesideAndAlongItsFaces) {
  EXPECT_EQ(leadsThrough(clamp(), at(0, 10, 16), at(100, 10, 16)), Truth::No);
  EXPECT_EQ(leadsThrough(clamp(), at(0, 10, 15), at(100, 10, 15)), Truth::No);
  EXPECT_EQ(leadsThrough(clamp(), at(0, 30, 5), at(100, 30, 5)), Truth::No);
  EXPECT_EQ(leadsThrough(clamp(), at(0, 0, 5), at(100, 0, 5)), Truth::No);
  EXPECT_EQ(leadsThrough(clamp(), at(30, 10, 50), at(30, 10, 15)), Truth::No);
}

TEST(Obstacle, IsNotSeenWhereAPlaceIsNotKnown) {
  Place unknown = at(0, 10, 5);
  unknown[2] = Interval::unknown();
  EXPECT_EQ(leadsThrough(clamp(), unknown, at(100, 10, 5)), Truth::Unknown);
  EXPECT_EQ(leadsThrough(clamp(), unknown, at(5, 10, 5)), Truth::No);
}

} // namespace
} // namespace ncvet
