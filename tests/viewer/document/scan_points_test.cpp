// The points of a scan as they are shown before there are patches.
#include "viewer/document/scan_points.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "tests/renderer/scenes.h"

namespace relief {
namespace {

/// A square grid of points at UTM coordinates, 1 apart.
Points field(int side) {
  Points points;
  for (int j = 0; j < side; ++j) {
    for (int i = 0; i < side; ++i) points.positions.emplace_back(5e5 + i, 4.6e6 + j, 100.0);
  }
  return points;
}

TEST(ScanPoints, KeepsEachFinitePointOnce) {
  Points points = field(50);
  points.positions[77].z = std::numeric_limits<double>::quiet_NaN();
  const ScanPoints shown = scan_points_of(points);
  ASSERT_EQ(shown.points.size(), 2499U);
  std::set<std::pair<float, float>> places;
  for (const ShownPoint& p : shown.points) places.emplace(p.position.x, p.position.y);
  EXPECT_EQ(places.size(), 2499U);
  EXPECT_EQ(shown.extent.stance, kZUp);
}

TEST(ScanPoints, AnyFirstPartIsSpreadOverAll) {
  const ScanPoints shown = scan_points_of(field(100));
  // A hundredth of the points, in quarters of the field: a random choice has 25 +- 4.3 in each.
  std::array<int, 4> quarters{};
  for (std::size_t k = 0; k < 100; ++k) {
    const glm::vec3 p = shown.points[k].position;
    ++quarters[(p.x > 0.0F ? 1U : 0U) + (p.y > 0.0F ? 2U : 0U)];
  }
  for (const int count : quarters) EXPECT_NEAR(count, 25, 9);
}

TEST(ScanPoints, KnowsAboutTheirSpacing) {
  // Of a plane half the box's surface is the field itself.
  EXPECT_NEAR(scan_points_of(field(100)).spacing, 1.0, 0.02);
}

TEST(ScanPoints, HasColoursOrShade) {
  Points points = field(3);
  points.colours.assign(9, {10, 20, 30});
  EXPECT_EQ(scan_points_of(points).points.front().colour, glm::u8vec4(10, 20, 30, 255));
  points.colours.clear();
  points.normals.assign(9, {0.0F, 0.0F, 2.0F});
  const auto up = scan_points_of(points).points.front().colour;
  points.normals.assign(9, {0.0F, 0.0F, -1.0F});
  EXPECT_GT(up.x, scan_points_of(points).points.front().colour.x + 100);
}

TEST(ScanPoints, OfPatchesAreSomeThatAreSpreadOverAll) {
  // A flat square of 500 samples a side, of which 150,000 are shown.
  const PatchModel model =
      test::model_of({test::sample_patch({.width = 500, .height = 500}, [](glm::dvec3) {
        return test::SurfacePoint{0.0, {0, 0, 1}};
      })});
  const ScanPoints shown = scan_points_of(model);
  EXPECT_NEAR(double(shown.points.size()), double{kMostShownSamples}, 10.0);
  EXPECT_NEAR(shown.spacing, std::sqrt(250'000.0 / kMostShownSamples), 1e-3);
  // In squares of 10 by 10 samples 60 are shown; at random it would be 60 +- 4.9, at most 15 off.
  std::map<std::pair<int, int>, int> counts;
  for (const ShownPoint& p : shown.points) {
    const glm::dvec3 at = glm::dvec3(p.position) + shown.origin;
    ++counts[{int(at.x / 10.0), int(at.y / 10.0)}];
  }
  EXPECT_EQ(counts.size(), 2500U);
  for (const auto& [square, count] : counts) EXPECT_NEAR(count, 60, 15);
}

TEST(ScanPoints, NothingOfNothing) {
  EXPECT_TRUE(scan_points_of(Points()).points.empty());
}

}  // namespace
}  // namespace relief
