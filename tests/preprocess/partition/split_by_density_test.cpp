// Regions of scans whose density differs.
#include "preprocess/partition/split_by_density.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "common/neighbours/neighbours.h"
#include "preprocess/convert.h"
#include "preprocess/partition/spacing_range.h"

namespace relief {
namespace {

/// A square of side 1 whose points are `ratio` times as far apart at x = 1 as at x = 0.
Points plane_of_density(double ratio) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> jitter(-0.25, 0.25);
  Points points;
  for (double x = 0.0; x < 1.0;) {
    const double spacing = 0.003 * std::pow(ratio, x);
    for (double y = 0.0; y < 1.0; y += spacing) {
      points.positions.emplace_back(x + jitter(random) * spacing, y + jitter(random) * spacing,
                                    0.0);
      points.normals.emplace_back(0.0F, 0.0F, 1.0F);
    }
    x += spacing;
  }
  return points;
}

/// A square of side 1 of so many points at random, and 200,000 in the hundredth of it at its
/// corner.
Points plane_with_a_dense_corner(std::size_t sparse) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(0.0, 1.0);
  Points points;
  for (std::size_t i = 0; i < sparse + 200000; ++i) {
    const double side = i < sparse ? 1.0 : 0.1;
    points.positions.emplace_back(side * place(random), side * place(random), 0.0);
    points.normals.emplace_back(0.0F, 0.0F, 1.0F);
  }
  return points;
}

/// The ratio of a region's spacings.
double density_ratio(const std::vector<float>& spacing, const Region& region) {
  return spacing_range(values_of(spacing, region)).ratio();
}

TEST(SpacingRange, SparsePartsOfFewPointsAndDensePartsOfLittleAreaShow) {
  EXPECT_EQ(spacing_range({}).ratio(), 1.0);
  EXPECT_EQ(spacing_range(std::vector<float>(100, 2.0F)).ratio(), 1.0);
  // 1,000 points a hundredth apart have a tenth of an area of 1, as 9 a third apart would.
  std::vector<float> spacings(1000, 0.01F);
  spacings.insert(spacings.end(), 9, 0.33F);
  EXPECT_FLOAT_EQ(spacing_range(spacings).dense, 0.01F);
  EXPECT_FLOAT_EQ(spacing_range(spacings).sparse, 0.33F);
  // A stray point of the least spacing, and one point in 1,001 at most, change nothing.
  spacings.assign(1000, 1.0F);
  spacings.push_back(1e-9F);
  EXPECT_EQ(spacing_range(spacings).ratio(), 1.0);
}

/// One region of all points, split.
std::vector<Region> split(const Points& points, const NeighbourGraph& graph) {
  const std::vector<float> roughness(points.size(), 0.0F);
  Region all{{}, {0.0F, 0.0F, 1.0F}};
  for (std::uint32_t i = 0; i < points.size(); ++i) all.points.push_back(i);
  return split_by_density({points.positions, points.normals, graph.spacing, roughness}, graph,
                          {all});
}

TEST(SplitByDensity, NoPieceIsWiderThanTheRatio) {
  const Points points = plane_of_density(30.0);
  const NeighbourGraph graph = find_neighbours(points.positions, kSurfaceNeighbours);
  const std::vector<Region> pieces = split(points, graph);
  EXPECT_GE(pieces.size(), 3U);
  EXPECT_LE(pieces.size(), 6U) << "noise of the density makes no pieces";
  std::size_t count = 0;
  for (const Region& piece : pieces) {
    // The outermost bands hold what lies beyond the tenths, too.
    EXPECT_LE(density_ratio(graph.spacing, piece), 1.1 * kWidestDensityRatio);
    EXPECT_TRUE(std::is_sorted(piece.points.begin(), piece.points.end()));
    count += piece.points.size();
  }
  EXPECT_EQ(count, points.size());
}

TEST(SplitByDensity, EvenScansStayWhole) {
  const Points points = plane_of_density(1.0);
  const NeighbourGraph graph = find_neighbours(points.positions, kSurfaceNeighbours);
  EXPECT_EQ(split(points, graph).size(), 1U);
}

TEST(SplitByDensity, DenseAndSparsePartsHaveTheirOwnSpacing) {
  // Fiftyfold density is a sevenfold spacing: one plane, of which no normal says where to split.
  ConvertOptions options;
  Progress progress;
  const auto result = convert(plane_of_density(std::sqrt(50.0)), options, progress);
  ASSERT_TRUE(result) << result.error().message;
  const auto [finest, coarsest] = std::ranges::minmax(
      result->model.patches, {}, [](const Patch& patch) { return patch.spacing; });
  EXPECT_GE(result->model.patches.size(), 2U);
  EXPECT_GT(coarsest.spacing, 2.0 * finest.spacing);
  EXPECT_EQ(result->report.uncovered_points, 0U);

  options.adaptive_spacing = false;
  const auto even = convert(plane_of_density(std::sqrt(50.0)), options, progress);
  ASSERT_TRUE(even) << even.error().message;
  EXPECT_EQ(even->report.finest_spacing, even->report.coarsest_spacing);
}

/// Whether a cell of the patches that has all corners covers a position of the plane z = 0.
bool covers(const std::vector<Patch>& patches, glm::dvec2 at) {
  return std::ranges::any_of(patches, [&](const Patch& patch) {
    const glm::dvec3 grid =
        glm::transpose(patch.axes) * (glm::dvec3(at, 0.0) - patch.origin) / patch.spacing;
    const auto i = static_cast<std::int64_t>(std::floor(grid.x));
    const auto j = static_cast<std::int64_t>(std::floor(grid.y));
    if (i < 0 || j < 0 || i + 1 >= patch.width || j + 1 >= patch.height) return false;
    const auto u = static_cast<std::uint32_t>(i);
    const auto v = static_cast<std::uint32_t>(j);
    return patch.at(u, v) != kHole && patch.at(u + 1, v) != kHole && patch.at(u, v + 1) != kHole &&
           patch.at(u + 1, v + 1) != kHole;
  });
}

// Points are 45 times as far apart beyond the corner: with one spacing each is a dot of its own.
TEST(SplitByDensity, StepsOfDensityLeaveNoGap) {
  Progress progress;
  const auto result = convert(plane_with_a_dense_corner(10000), {}, progress);
  ASSERT_TRUE(result) << result.error().message;
  const PatchModel& model = result->model;
  EXPECT_LT(result->report.finest_spacing, 0.0003) << "as dense as the corner";
  EXPECT_GT(result->report.coarsest_spacing, 0.007) << "as sparse as the rest";
  int bare = 0;
  for (double y = 0.02; y < 0.98; y += 0.0021) {
    for (double x = 0.02; x < 0.98; x += 0.0021) bare += covers(model.patches, {x, y}) ? 0 : 1;
  }
  EXPECT_EQ(bare, 0);
}

}  // namespace
}  // namespace relief
