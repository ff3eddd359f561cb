#include "common/neighbours/neighbours.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <numeric>

#include "preprocess/points/point_radii.h"
#include "tests/preprocess/surfaces.h"

namespace relief {
namespace {

TEST(Neighbours, AgreeWithBruteForce) {
  const Points points = test::sample_sphere(400);
  const NeighbourGraph graph = find_neighbours(points.positions, 10);
  ASSERT_EQ(graph.k, 10U);
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    std::vector<std::uint32_t> all(points.size());
    std::iota(all.begin(), all.end(), 0U);
    std::erase(all, i);
    std::sort(all.begin(), all.end(), [&](std::uint32_t a, std::uint32_t b) {
      return glm::distance(points.positions[a], points.positions[i]) <
             glm::distance(points.positions[b], points.positions[i]);
    });
    all.resize(10);
    EXPECT_EQ(std::vector<std::uint32_t>(graph.of(i).begin(), graph.of(i).end()), all);
  }
}

TEST(Neighbours, FewerPointsThanNeighboursGiveAllOthers) {
  const Points points = test::sample_sphere(5);
  const NeighbourGraph graph = find_neighbours(points.positions, 16);
  EXPECT_EQ(graph.k, 4U);
  EXPECT_EQ(graph.indices.size(), 20U);
}

TEST(Neighbours, OnePointAndNoneHaveNoNeighbours) {
  const NeighbourGraph one = find_neighbours({glm::dvec3(1.0)}, 16);
  EXPECT_EQ(one.k, 0U);
  EXPECT_TRUE(one.indices.empty());
  EXPECT_EQ(find_neighbours({}, 16).k, 0U);
}

TEST(Neighbours, DuplicatesAreNeighboursAtNoDistance) {
  std::vector<glm::dvec3> positions(12, glm::dvec3(2.0));
  positions.emplace_back(3.0, 2.0, 2.0);
  const NeighbourGraph graph = find_neighbours(positions, 8);
  for (std::uint32_t i = 0; i < 12; ++i) {
    for (const std::uint32_t j : graph.of(i)) {
      EXPECT_NE(j, i);
      EXPECT_LT(j, 12U);
    }
    EXPECT_EQ(graph.spacing[i], 0.0F);
  }
  EXPECT_GT(graph.spacing[12], 0.0F);
}

TEST(Neighbours, SpacingIsTheDistanceBetweenSamples) {
  constexpr double kGridStep = 0.02;
  const Points points =
      test::sample_height_field(0.5, kGridStep, [](double, double) { return 0.0; });
  const NeighbourGraph graph = find_neighbours(points.positions, 16);
  double sum = 0.0;
  std::size_t inner = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (std::abs(points.positions[i].x) > 0.4 || std::abs(points.positions[i].y) > 0.4) continue;
    sum += graph.spacing[i];
    ++inner;
  }
  // The 8th neighbour of a square grid is at sqrt(2) steps, which gives 0.89; jitter moves it
  // outward.
  EXPECT_NEAR(sum / static_cast<double>(inner), kGridStep, 0.12 * kGridStep);
}

/// Drops every `step`-th of so many points; the graph of what is left is that of a new search.
void expect_as_searched(int count, std::size_t step) {
  const std::vector<glm::dvec3> all = test::sample_sphere(count).positions;
  std::vector<std::uint8_t> dropped(all.size(), 0);
  std::vector<glm::dvec3> left;
  for (std::size_t i = 0; i < all.size(); ++i) {
    dropped[i] = i % step == 0 ? 1 : 0;
    if (dropped[i] == 0) left.push_back(all[i]);
  }
  const NeighbourGraph graph =
      neighbours_after_drop(find_neighbours(all, kSurfaceNeighbours), dropped, left);
  const NeighbourGraph searched = find_neighbours(left, kSurfaceNeighbours);
  EXPECT_EQ(graph.k, searched.k);
  EXPECT_EQ(graph.indices, searched.indices);
  EXPECT_EQ(graph.spacing, searched.spacing);
}

TEST(NeighboursAfterDrop, AreThoseOfANewSearch) {
  expect_as_searched(3000, 100);
  expect_as_searched(3000, 2);
}

TEST(ReorderedNeighbours, AreThoseOfTheReorderedPoints) {
  const std::vector<glm::dvec3> positions = test::sample_torus({}, 0.1).positions;
  std::vector<std::uint32_t> order(positions.size());
  std::iota(order.rbegin(), order.rend(), 0U);
  std::rotate(order.begin(), order.begin() + 7, order.end());  // clang 14 has no ranges::rotate
  std::vector<glm::dvec3> moved;
  for (const std::uint32_t i : order) moved.push_back(positions[i]);
  const NeighbourGraph found = find_neighbours(moved, kSurfaceNeighbours);
  const NeighbourGraph graph = reordered(find_neighbours(positions, kSurfaceNeighbours), order);
  EXPECT_EQ(graph.indices, found.indices);
  EXPECT_EQ(graph.spacing, found.spacing);
}

TEST(NeighboursAfterDrop, OfFewPointsAreFewer) {
  expect_as_searched(20, 2);
}

TEST(PointRadii, FollowTheSpacingAndKeepOutliersSmall) {
  constexpr double kGridStep = 0.02;
  Points points = test::sample_height_field(0.5, kGridStep, [](double, double) { return 0.0; });
  points.positions.emplace_back(0.0, 0.0, 5.0);
  const NeighbourGraph graph = find_neighbours(points.positions, 16);
  const std::vector<double> radii = find_radii(graph);
  ASSERT_EQ(radii.size(), points.positions.size());
  double sum = 0.0;
  std::size_t inner = 0;
  for (std::size_t i = 0; i + 1 < radii.size(); ++i) {
    if (std::abs(points.positions[i].x) > 0.4 || std::abs(points.positions[i].y) > 0.4) continue;
    sum += radii[i];
    ++inner;
  }
  // 1.2 spacings, those with the tolerance above.
  EXPECT_NEAR(sum / static_cast<double>(inner), 1.2 * kGridStep, 0.12 * 1.2 * kGridStep);
  // Its 8th neighbour is 5 away; twice the spacing of its neighbours is 0.04, and 1.2 times that.
  EXPECT_NEAR(radii.back(), 2.0 * 1.2 * kGridStep, 0.2 * kGridStep * 2.4);
}

}  // namespace
}  // namespace relief
