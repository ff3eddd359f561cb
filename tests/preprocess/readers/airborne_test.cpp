// Which scans look airborne.
#include "preprocess/readers/las/airborne.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace relief {
namespace {

/// Points a metre apart, seen evenly from above, on ground with houses of 6 m.
std::vector<glm::dvec3> town(double side) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(0.0, side);
  std::vector<glm::dvec3> points;
  for (int i = 0; i < static_cast<int>(side * side); ++i) {
    const double x = place(random);
    const double y = place(random);
    const bool is_house = std::fmod(x, 40.0) < 10.0 && std::fmod(y, 40.0) < 10.0;
    points.emplace_back(x, y, (is_house ? 6.0 : 0.0) + 0.01 * x);
  }
  return points;
}

TEST(Airborne, IsATownSeenEvenlyFromAbove) {
  EXPECT_TRUE(looks_airborne(town(150.0), false));
}

TEST(Airborne, IsNoScanAsHighAsWide) {
  std::vector<glm::dvec3> points = town(150.0);
  for (glm::dvec3& p : points) p.z *= 20.0;
  EXPECT_FALSE(looks_airborne(points, true));
}

// A scanner on the ground: as many points in each ring about it.
TEST(Airborne, IsNoScanCrowdedAboutItsScanner) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<glm::dvec3> points;
  for (int i = 0; i < 20'000; ++i) {
    const double radius = std::exp(5.0 * unit(random));
    const double angle = 6.2831853 * unit(random);
    points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0.1 * unit(random));
  }
  EXPECT_FALSE(looks_airborne(points, true));
}

// Half of the points are below others: bodies scanned from all sides, or trees if pulses had
// several echoes.
TEST(Airborne, NeedsSeveralReturnsWherePointsStandOverOthers) {
  std::vector<glm::dvec3> points = town(150.0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].x < 90.0 && i % 2 == 0) points[i].z += 15.0;
  }
  EXPECT_FALSE(looks_airborne(points, false));
  EXPECT_TRUE(looks_airborne(points, true));
}

TEST(Airborne, IsNotSaidOfAFewPoints) {
  EXPECT_FALSE(looks_airborne({}, true));
  EXPECT_FALSE(looks_airborne(town(10.0), true));
  EXPECT_FALSE(looks_airborne(std::vector<glm::dvec3>(2000, glm::dvec3(1, 2, 3)), true));
}

}  // namespace
}  // namespace relief
