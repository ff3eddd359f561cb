// Which nodes get a sample, from points that are laid out by hand.
#include "preprocess/resample/support/support.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "preprocess/resample/support/node_support.h"
#include "tests/preprocess/resample/laid_points.h"

namespace relief {
namespace {

/// Columns of points, one spacing apart along y, as seen in the frame of a patch.
class Columns {
 public:
  void add(double x) {
    for (int y = 0; y < kRows; ++y)
      test::lay_point(points, {x, y, 0.0}, {0.0F, 0.0F, 1.0F}, kScanSpacing);
  }

  /// The states of the nodes in the middle row at x = 0, 1, ... 9.
  [[nodiscard]] std::vector<NodeState> middle_row(int overlap_cells) const {
    const PointGrid own(points, points.own, 1.0);
    const PointGrid supporting(points, points.supporting, 1.0);
    const PointGrid all(points, points.size(), 1.0);
    const PatchGrid grid{0.0, 0.0, 1.0, 10, kRows};
    const std::vector<NodeState> states =
        find_support(points, {own, supporting, all}, grid, overlap_cells);
    const auto row = states.begin() + std::ptrdiff_t{kRows / 2} * grid.width;
    return {row, row + grid.width};
  }

  PatchPoints points;

 private:
  static constexpr int kRows = 9;
  // Of a scan so dense that these columns are apart, and nothing between them is surrounded.
  static constexpr float kScanSpacing = 0.4F;
};

constexpr NodeState kOwn = NodeState::Own;
constexpr NodeState kMargin = NodeState::Margin;
constexpr NodeState kHoleNode = NodeState::Hole;

TEST(Support, ClosesASlitBetweenMarginsWhereSteepPointsAre) {
  Columns columns;
  for (const double x : {0.0, 1.0, 2.0, 7.0, 8.0, 9.0}) columns.add(x);
  columns.points.own = columns.points.size();
  columns.add(2.95);
  columns.add(6.05);
  columns.points.supporting = columns.points.size();
  // Two margin nodes of each side, and between them a slit of two nodes, then of one.
  columns.add(4.5);
  const std::vector<NodeState> two{kOwn,      kOwn,    kOwn, kMargin, kHoleNode,
                                   kHoleNode, kMargin, kOwn, kOwn,    kOwn};
  EXPECT_EQ(columns.middle_row(1), two);

  Columns closer;
  for (const double x : {0.0, 1.0, 2.0, 6.0, 7.0, 8.0, 9.0}) closer.add(x);
  closer.points.own = closer.points.size();
  closer.add(2.95);
  closer.add(5.05);
  closer.points.supporting = closer.points.size();
  const std::vector<NodeState> one{kOwn,    kOwn, kOwn, kMargin, kMargin,
                                   kMargin, kOwn, kOwn, kOwn,    kOwn};
  EXPECT_EQ(closer.middle_row(1), one);
  // Without a margin there is no slit of one node to close.
  const std::vector<NodeState> none{kOwn,      kOwn, kOwn, kHoleNode, kHoleNode,
                                    kHoleNode, kOwn, kOwn, kOwn,      kOwn};
  EXPECT_EQ(closer.middle_row(0), none);
}

TEST(Support, OfANodeMatchesTheDirectTest) {
  // Points at random, denser to the right, with a gap; 20 nodes beyond them on all sides.
  std::mt19937 random(8);
  const auto next = [&random] { return static_cast<double>(random()) * 0x1p-32; };
  PatchPoints points;
  for (std::uint32_t k = 0; k < 1500; ++k) {
    const glm::dvec3 position(30.0 * std::sqrt(next()), 30.0 * next(), 4.0 * next());
    if (glm::distance(glm::dvec2(position), glm::dvec2(20.0, 15.0)) < 4.0) continue;
    points.ids.push_back(k);
    points.positions.push_back(position);
    points.normals.emplace_back(0.0F, 0.0F, 1.0F);
    points.spacing.push_back(static_cast<float>(0.2 + 2.0 * next()));
  }
  const PointGrid lookup(points, points.size(), 1.0);
  for (const double spacing : {0.4, 1.0, 2.3}) {
    const auto side = static_cast<std::uint32_t>(70.0 / spacing);
    const PatchGrid grid{-20.0, -20.0, spacing, side, side};
    const NodeSupport nodes(points, lookup, grid);
    std::size_t supported = 0;
    for (std::uint32_t j = 0; j < side; ++j) {
      for (std::uint32_t i = 0; i < side; ++i) {
        const bool truth =
            is_supported(points, lookup, grid.x0 + i * spacing, grid.y0 + j * spacing, spacing);
        ASSERT_EQ(nodes.is_supported(i, j), truth) << spacing << ": " << i << ", " << j;
        supported += truth ? 1 : 0;
      }
    }
    EXPECT_GT(supported, grid.size() / 20);
    EXPECT_LT(supported, grid.size() / 2);
  }
}

}  // namespace
}  // namespace relief
