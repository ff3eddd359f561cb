// Nearest positions on triangles against the nearest of many on them.
#include "common/mesh/nearest_on_triangle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

namespace relief {
namespace {

/// The distance to the nearest of a lattice of positions on the triangle.
double distance_to_lattice(glm::dvec3 p, glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
  constexpr int kSteps = 60;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= kSteps; ++i) {
    for (int j = 0; i + j <= kSteps; ++j) {
      const double u = static_cast<double>(i) / kSteps;
      const double v = static_cast<double>(j) / kSteps;
      least = std::min(least, glm::distance(p, a + u * (b - a) + v * (c - a)));
    }
  }
  return least;
}

TEST(NearestOnTriangle, IsNearerThanAnyOther) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> at(-1.0, 1.0);
  const auto position = [&] { return glm::dvec3(at(random), at(random), at(random)); };
  for (int k = 0; k < 200; ++k) {
    const glm::dvec3 a = position();
    const glm::dvec3 b = position();
    const glm::dvec3 c = position();
    const glm::dvec3 p = 2.0 * position();
    const double distance = glm::distance(p, nearest_on_triangle(p, a, b, c));
    const double lattice = distance_to_lattice(p, a, b, c);
    EXPECT_LE(distance, lattice + 1e-12);
    // The lattice's steps are at most 3.5 / 60 long.
    EXPECT_GE(distance, lattice - 0.06);
  }
}

TEST(NearestOnTriangle, IsOnSegmentsAndPoints) {
  const glm::dvec3 a(0.0);
  const glm::dvec3 b(2.0, 0.0, 0.0);
  EXPECT_EQ(nearest_on_triangle({1.0, 1.0, 0.0}, a, b, b), glm::dvec3(1.0, 0.0, 0.0));
  EXPECT_EQ(nearest_on_triangle({1.0, 1.0, 0.0}, b, b, b), b);
}

}  // namespace
}  // namespace relief
