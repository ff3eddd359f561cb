#include "preprocess/tiles/tile_layout.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/common.hpp>

#include "tests/preprocess/surfaces.h"

namespace relief {
namespace {

TileLayout lay(const std::vector<glm::dvec3>& points, std::uint64_t tile_points) {
  PointSample sample;
  for (const glm::dvec3& p : points) sample.add(p);
  return lay_tiles(sample, tile_points, 0.0);
}

bool is_within(const Bounds& box, glm::dvec3 p, double margin) {
  for (int axis = 0; axis < 3; ++axis) {
    if (p[axis] < box.min[axis] - margin || p[axis] > box.max[axis] + margin) return false;
  }
  return true;
}

TEST(TileLayout, TilesStayWithinTheLimit) {
  const std::vector<glm::dvec3> points = test::sample_sphere(30000).positions;
  const TileLayout layout = lay(points, 4000);
  std::vector<std::size_t> count(layout.tiles.size());
  for (const glm::dvec3& p : points) ++count[layout.tile_of(p)];
  // Halved three times; every point was in the sample, so that medians are exact.
  EXPECT_EQ(layout.tiles.size(), 8U);
  EXPECT_LE(*std::ranges::max_element(count), 4000U);
  EXPECT_GE(*std::ranges::min_element(count), 3700U);
}

TEST(TileLayout, HalosHaveWhatIsNearAndNothingElse) {
  const std::vector<glm::dvec3> points = test::sample_sphere(20000).positions;
  const TileLayout layout = lay(points, 3000);
  ASSERT_GT(layout.tiles.size(), 4U);
  std::vector<std::uint32_t> found;
  std::size_t in_halos = 0;
  for (const glm::dvec3& p : points) {
    const std::uint32_t own = layout.tile_of(p);
    EXPECT_TRUE(is_within(layout.tiles[own].region, p, 0.0));
    layout.find_halos(p, own, found);
    std::ranges::sort(found);
    std::vector<std::uint32_t> expected;
    for (std::uint32_t t = 0; t < layout.tiles.size(); ++t) {
      if (t != own && is_within(layout.tiles[t].region, p, layout.tiles[t].halo))
        expected.push_back(t);
    }
    ASSERT_EQ(found, expected);
    in_halos += found.size();
  }
  EXPECT_GT(in_halos, 0U);
}

// 20,000 points on a sphere are 0.025 apart.
TEST(TileLayout, HalosAreTwelveSpacingsWide) {
  const TileLayout layout = lay(test::sample_sphere(20000).positions, 3000);
  for (const Tile& tile : layout.tiles) EXPECT_NEAR(tile.halo, 12.0 * 0.025, 0.1 * 12.0 * 0.025);
}

// Each sampled point stands for four here, which are half as far apart.
TEST(TileLayout, HalosOfAThinnedSampleAreThoseOfTheScan) {
  const std::vector<glm::dvec3> points =
      test::sample_height_field(1.0, 0.002, [](double x, double) { return 0.1 * x * x; }).positions;
  PointSample sample;
  for (const glm::dvec3& p : points) sample.add(p);
  EXPECT_EQ(sample.stride(), 4U);
  EXPECT_NEAR(static_cast<double>(sample.points().size() * sample.stride()),
              static_cast<double>(points.size()), 8.0);
  const TileLayout layout = lay_tiles(sample, 100000, 0.0);
  // The sample is every fourth point along rows: farther apart along them than across, which the
  // mean over directions evens out to a tenth or two.
  for (const Tile& tile : layout.tiles) EXPECT_NEAR(tile.halo, 12.0 * 0.002, 0.25 * 12.0 * 0.002);
}

TEST(TileLayout, OutliersDoNotMakeSlabs) {
  std::vector<glm::dvec3> points = test::sample_sphere(20000).positions;
  for (int i = 0; i < 20; ++i) points.emplace_back(1e6 + i, 0.0, 0.0);
  const TileLayout layout = lay(points, 3000);
  std::vector<Bounds> boxes(layout.tiles.size());
  for (const glm::dvec3& p : points) {
    if (p.x > 2.0) continue;
    Bounds& box = boxes[layout.tile_of(p)];
    if (box.empty()) box = {p, p};
    extend(box, p);
  }
  for (const Bounds& box : boxes) {
    const glm::dvec3 size = box.max - box.min;
    // An eighth of a sphere, cut in halves: 1 by 1 by 1 or so, a slab would be 0.1 thick.
    EXPECT_GT(std::min({size.x, size.y, size.z}), 0.3);
  }
}

TEST(TileLayout, PointsThatAllCoincideAreOneTile) {
  const TileLayout layout = lay(std::vector<glm::dvec3>(1000, glm::dvec3(1.0, 2.0, 3.0)), 100);
  EXPECT_EQ(layout.tiles.size(), 1U);
  EXPECT_EQ(layout.tile_of(glm::dvec3(7.0)), 0U);
}

TEST(TileLayout, CoarserTilesAreWholeOnes) {
  const std::vector<glm::dvec3> points = test::sample_sphere(30000).positions;
  const TileLayout fine = lay(points, 2000);
  ASSERT_EQ(fine.tiles.size(), 16U);
  // Each has a quarter of about 1,900 points, and one has many more.
  std::vector<double> load(fine.tiles.size(), 470.0);
  load[5] = 3000.0;
  const TileLayout coarse = coarser_layout(fine, load, 2000.0, 0.1);
  std::vector<double> together(coarse.tiles.size());
  for (std::size_t t = 0; t < fine.tiles.size(); ++t)
    together[coarse.tile_about(fine.tiles[t])] += load[t];
  // Groups of four except at the full tile: it and its sibling are separate, the two beside them
  // joined.
  std::ranges::sort(together);
  EXPECT_EQ(together, (std::vector<double>{470.0, 940.0, 1880.0, 1880.0, 1880.0, 3000.0}));
  EXPECT_DOUBLE_EQ(coarse.largest_halo, 1.2);
  for (const glm::dvec3& p : points) {
    const std::uint32_t tile = coarse.tile_of(p);
    ASSERT_EQ(tile, coarse.tile_about(fine.tiles[fine.tile_of(p)]));
    ASSERT_TRUE(is_within(coarse.tiles[tile].region, p, 0.0));
  }
}

TEST(TileLayout, AllIsOneTileWhereThatIsEnough) {
  const TileLayout fine = lay(test::sample_sphere(30000).positions, 4000);
  const TileLayout whole = coarser_layout(fine, std::vector<double>(8, 1.0), 8.0, 0.1);
  EXPECT_EQ(whole.tiles.size(), 1U);
  EXPECT_EQ(whole.tile_of({1e9, -1e9, 0.0}), 0U);
  EXPECT_EQ(coarser_layout(whole, std::vector<double>(1, 5.0), 1.0, 0.2).tiles.size(), 1U);
}

}  // namespace
}  // namespace relief
