#include "common/extremes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <random>

namespace relief {
namespace {

std::vector<glm::dvec3> ellipsoid(glm::dvec3 centre, glm::dvec3 half, int count) {
  std::mt19937 random(3);
  std::normal_distribution<double> any;
  std::vector<glm::dvec3> points;
  for (int i = 0; i < count; ++i)
    points.push_back(centre +
                     half * glm::normalize(glm::dvec3(any(random), any(random), any(random))));
  return points;
}

double farthest(const std::vector<glm::dvec3>& points, const glm::dvec3& direction) {
  double most = -std::numeric_limits<double>::infinity();
  for (const glm::dvec3& p : points) most = std::max(most, glm::dot(p, direction));
  return most;
}

TEST(ExtremePoints, ReachAlmostAsFarAsAllInAnyDirection) {
  for (const glm::dvec3 half : {glm::dvec3(1.0), glm::dvec3(1.0, 20.0, 0.05)}) {
    const glm::dvec3 centre(6e5, 5e6, 300.0);
    const auto points = ellipsoid(centre, half, 20000);
    const auto extremes = extreme_points(points, bounds_of(points));
    EXPECT_LE(extremes.size(), 98U);
    std::mt19937 random(5);
    std::normal_distribution<double> any;
    for (int i = 0; i < 500; ++i) {
      const glm::dvec3 direction(any(random), any(random), any(random));
      const double all = farthest(points, direction) - glm::dot(centre, direction);
      const double some = farthest(extremes, direction) - glm::dot(centre, direction);
      EXPECT_GT(some, 0.95 * all);
      EXPECT_LT(some, 1.0001 * all) << "coordinates are rounded to 1/65535 of the bounds";
    }
  }
}

TEST(ExtremePoints, AreTheSameForTheirOwnPositionsAndInAnyOrder) {
  auto points = ellipsoid({1.0, 2.0, 3.0}, {1.0, 2.0, 3.0}, 5000);
  const Bounds bounds = bounds_of(points);
  const auto extremes = extreme_points(points, bounds);
  EXPECT_EQ(extreme_points(extremes, bounds), extremes);
  for (const glm::dvec3& p : extremes) EXPECT_EQ(extreme_at(extreme_steps(p, bounds), bounds), p);
}

TEST(ExtremePoints, OfFlatAndSinglePoints) {
  const std::vector<glm::dvec3> one{{1.0, 2.0, 3.0}};
  EXPECT_EQ(extreme_points(one, bounds_of(one)), one);
  EXPECT_TRUE(extreme_points({}, Bounds{}).empty());
  const std::vector<glm::dvec3> square{{0, 0, 5}, {1, 0, 5}, {0, 1, 5}, {1, 1, 5}, {0.5, 0.5, 5}};
  EXPECT_EQ(extreme_points(square, bounds_of(square)).size(), 4U);
  EXPECT_EQ(corners_of(bounds_of(square)).size(), 8U);
  EXPECT_TRUE(corners_of(Bounds{}).empty());
}

}  // namespace
}  // namespace relief
