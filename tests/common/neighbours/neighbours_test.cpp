#include "common/neighbours/neighbours.h"

#include <gtest/gtest.h>

#include <random>

namespace relief {
namespace {

std::vector<glm::dvec3> positions_in_a_slab(int count) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> inside(-1.0, 1.0);
  std::vector<glm::dvec3> positions;
  for (int i = 0; i < count; ++i)
    positions.emplace_back(inside(random), inside(random), 0.1 * inside(random));
  return positions;
}

/// Drops every `step`-th position; the graph of what is left is that of a new search.
void expect_as_searched(int count, std::size_t step) {
  const std::vector<glm::dvec3> all = positions_in_a_slab(count);
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

TEST(NeighboursAfterDrop, OfFewPointsAreFewer) {
  expect_as_searched(20, 2);
}

}  // namespace
}  // namespace relief
