// --clean and --thin: what goes, what stays, and with what.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <set>

#include "preprocess/points/outliers.h"
#include "preprocess/points/thin.h"

namespace relief {
namespace {

/// A plane of 60 x 60 points a unit apart, shaken by a tenth, with triangles and colours that tell
/// the point.
Points plane() {
  Points points;
  std::mt19937 random(1);
  std::normal_distribution<double> shake(0.0, 0.1);
  for (std::uint32_t y = 0; y < 60; ++y) {
    for (std::uint32_t x = 0; x < 60; ++x) {
      points.positions.emplace_back(x + shake(random), y + shake(random), shake(random));
      points.colours.emplace_back(x, y, 0);
      const std::uint32_t i = 60 * y + x;
      if (x > 0 && y > 0) points.triangles.push_back({i - 61, i - 60, i});
    }
  }
  return points;
}

void add(Points& points, glm::dvec3 p) {
  points.positions.push_back(p);
  points.colours.emplace_back(0, 0, 255);
}

TEST(Outliers, NothingGoesFromACleanSurface) {
  Points points = plane();
  Progress progress;
  const OutlierReport report = remove_outliers(points, progress);
  EXPECT_EQ(report.sparse + report.cluster, 0U);
  EXPECT_FALSE(report.were_too_many);
  EXPECT_EQ(points.positions, plane().positions);
  EXPECT_EQ(points.triangles.size(), plane().triangles.size());
}

TEST(Outliers, SinglePointsAndSmallClustersGoWithTheirTriangles) {
  Points points = plane();
  const auto count = static_cast<std::uint32_t>(points.size());
  for (int k = 0; k < 20; ++k) add(points, {3.0 * k, 2.0 * k, 8.0 + k % 3});  // spikes above it
  for (int k = 0; k < 30; ++k) add(points, {100.0 + k % 6, k / 6, 40.0});     // a scrap of surface
  points.triangles.push_back({0, 1, count});
  points.triangles.push_back({count + 20, count + 21, count + 26});
  Progress progress;
  const OutlierReport report = remove_outliers(points, progress);
  EXPECT_EQ(report.sparse + report.cluster, 50U);
  EXPECT_GE(report.sparse, 20U);
  ASSERT_EQ(points.size(), count);
  EXPECT_EQ(points.colours, plane().colours);
  EXPECT_EQ(points.triangles, plane().triangles);
}

TEST(Outliers, ASurfaceOfItsOwnStays) {
  Points points = plane();
  for (int k = 0; k < 100; ++k) add(points, {100.0 + k % 10, k / 10, 40.0});
  Progress progress;
  const OutlierReport report = remove_outliers(points, progress);
  EXPECT_EQ(report.sparse + report.cluster, 0U);
}

/// Three times sparser to one side, as a room is seen by a scanner that stands at its other end.
TEST(Outliers, SparserSurfacesStay) {
  Points points;
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 60; ++x) {
      const double far = 1.0 + 2.0 * x / 59.0;
      points.positions.emplace_back(x * (1.0 + x / 59.0), y * far, 0.0);
    }
  }
  Progress progress;
  const OutlierReport report = remove_outliers(points, progress);
  EXPECT_EQ(report.sparse + report.cluster, 0U);
}

TEST(Outliers, AScanThatIsAllDustStays) {
  Points points;
  for (int k = 0; k < 40; ++k) add(points, {k * k * 1.0, (k * 7) % 11, (k * 5) % 13});
  Progress progress;
  const OutlierReport report = remove_outliers(points, progress);
  EXPECT_TRUE(report.were_too_many);
  EXPECT_EQ(report.sparse + report.cluster, 0U);
  EXPECT_EQ(points.size(), 40U);
}

TEST(Thin, OnePointOfEachCubeStays) {
  Points points;
  // Two cubes of side 2, across zero; the mean of the right one's is (1, 0, 0).
  for (const double x : {-0.5, 0.2, 0.9, 1.9}) add(points, {x, 0.0, 0.0});
  for (std::size_t i = 0; i < 4; ++i) points.colours[i].r = static_cast<std::uint8_t>(i);
  points.triangles = {{0, 1, 2}, {0, 2, 3}};
  EXPECT_EQ(thin_points(points, 2.0), 2U);
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points.positions[0].x, -0.5);
  EXPECT_EQ(points.positions[1].x, 0.9);
  EXPECT_EQ(points.colours[1].r, 2);
  EXPECT_TRUE(points.triangles.empty());
}

TEST(Thin, EveryCubeKeepsOneFarFromTheOrigin) {
  Points points = plane();
  for (glm::dvec3& p : points.positions) p += glm::dvec3(5e6, 5e6, 0.0);
  const auto cubes_of = [](const Points& scan) {
    std::set<std::array<double, 3>> cubes;
    for (const glm::dvec3& p : scan.positions)
      cubes.insert({std::floor(p.x / 2.0), std::floor(p.y / 2.0), std::floor(p.z / 2.0)});
    return cubes;
  };
  const auto cubes = cubes_of(points);
  EXPECT_EQ(thin_points(points, 2.0), 3600U - cubes.size());
  EXPECT_EQ(points.size(), cubes.size());
  EXPECT_EQ(cubes_of(points), cubes);
}

TEST(Thin, CubesThatAreTooSmallTakeNothing) {
  Points points = plane();
  EXPECT_EQ(thin_points(points, 1e-320), 0U);
  EXPECT_EQ(points.size(), 3600U);
}

}  // namespace
}  // namespace relief
