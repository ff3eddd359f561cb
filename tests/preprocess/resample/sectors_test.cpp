#include "preprocess/resample/support/sectors.h"

#include <gtest/gtest.h>

#include <random>

namespace relief {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

struct Looks {
  double widest = 0.0;  ///< degrees
  bool may_leave = false;
};

Looks look(std::vector<double> angles) {
  TwelveSectors sectors;
  for (const double angle : angles) sectors.add(std::cos(angle), std::sin(angle));
  return {widest_sectors(angles).width / kDegree, sectors.may_leave_120_degrees()};
}

// The first look may say that there is such a sector where there is none, never the other way.
TEST(TwelveSectors, MissNoSectorOf120Degrees) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> circle(-180.0, 180.0);
  int wide = 0;
  int passed = 0;
  for (int trial = 0; trial < 5000; ++trial) {
    std::vector<double> angles(4 + trial % 16);
    for (double& angle : angles) angle = circle(random) * kDegree;
    const Looks looks = look(angles);
    if (looks.widest >= 120.0) {
      ++wide;
      EXPECT_TRUE(looks.may_leave) << looks.widest << " degrees";
    }
    // Three empty ones of twelve are at least 90 degrees.
    if (looks.widest < 90.0) {
      ++passed;
      EXPECT_FALSE(looks.may_leave) << looks.widest << " degrees";
    }
  }
  EXPECT_GT(wide, 500);
  EXPECT_GT(passed, 500);
}

TEST(TwelveSectors, OfNoDirectionAreEmpty) {
  TwelveSectors sectors;
  EXPECT_TRUE(sectors.may_leave_120_degrees());
  sectors.add(0.0, 0.0);
  EXPECT_TRUE(sectors.may_leave_120_degrees());
}

}  // namespace
}  // namespace relief
