// Regions of scans whose density differs.
#include "preprocess/partition/split_by_density.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "common/neighbours/neighbours.h"
#include "preprocess/convert.h"

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

/// Of a region: the spacing that a tenth of its area exceeds over the one that a tenth falls below.
double density_ratio(const std::vector<float>& spacing, const Region& region) {
  std::vector<float> own;
  for (const std::uint32_t i : region.points) own.push_back(spacing[i]);
  std::sort(own.begin(), own.end());
  double area = 0.0;
  for (const float s : own) area += double{s} * s;
  double dense = 0.0;
  double sparse = 0.0;
  double below = 0.0;
  for (const float s : own) {
    below += double{s} * s;
    if (below < 0.1 * area) dense = s;
    if (below < 0.9 * area) sparse = s;
  }
  return sparse / dense;
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

TEST(SplitByDensity, AdaptiveSpacingGivesDenseAndSparsePartsTheirOwn) {
  // Fiftyfold density is a sevenfold spacing: one plane, of which no normal says where to split.
  ConvertOptions options;
  options.adaptive_spacing = true;
  Progress progress;
  const auto result = convert(plane_of_density(std::sqrt(50.0)), options, progress);
  ASSERT_TRUE(result) << result.error().message;
  const auto [finest, coarsest] = std::ranges::minmax(
      result->model.patches, {}, [](const Patch& patch) { return patch.spacing; });
  EXPECT_GE(result->model.patches.size(), 2U);
  EXPECT_GT(coarsest.spacing, 2.0 * finest.spacing);
  EXPECT_EQ(result->report.uncovered_points, 0U);
}

}  // namespace
}  // namespace relief
