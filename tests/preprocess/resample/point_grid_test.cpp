// The nearest point on the base plane.
#include "preprocess/resample/surroundings/point_grid.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/preprocess/resample/laid_points.h"

namespace relief {
namespace {

/// The first of the points nearest to a position within a radius, one after another.
std::uint32_t nearest_of_all(const PatchPoints& points, double x, double y, double radius) {
  std::uint32_t best = PointGrid::kNone;
  double best_squared = radius * radius;
  for (std::uint32_t p = 0; p < points.size(); ++p) {
    const double dx = points.positions[p].x - x;
    const double dy = points.positions[p].y - y;
    const double squared = dx * dx + dy * dy;
    if (squared > best_squared || (squared == best_squared && best != PointGrid::kNone)) continue;
    best = p;
    best_squared = squared;
  }
  return best;
}

/// Points in two clusters, some of them in the same place: many buckets are empty.
PatchPoints lay_clusters() {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  PatchPoints points;
  for (int p = 0; p < 200; ++p) {
    const double middle = p % 2 == 0 ? 0.0 : 9.0;
    const glm::dvec3 position(middle + normal(random), 0.3 * normal(random), 0.0);
    test::lay_point(points, position, {0, 0, 1}, 0.1F);
    if (p % 10 == 0) test::lay_point(points, position, {0, 0, 1}, 0.1F);
  }
  return points;
}

TEST(PointGrid, FindsTheNearestPointInsideAndFarBeside) {
  const PatchPoints points = lay_clusters();
  std::mt19937 random(2);
  std::uniform_real_distribution<double> anywhere(-30.0, 30.0);
  for (const double cell : {0.1, 1.0, 50.0}) {
    const PointGrid grid(points, points.size(), cell);
    for (int i = 0; i < 500; ++i) {
      const double x = anywhere(random);
      const double y = anywhere(random) * (i % 3 == 0 ? 0.02 : 1.0);
      for (const double radius : {0.5, 5.0, 1e9}) {
        EXPECT_EQ(grid.nearest(x, y, radius), nearest_of_all(points, x, y, radius))
            << cell << ' ' << x << ' ' << y << ' ' << radius;
      }
    }
  }
}

}  // namespace
}  // namespace relief
