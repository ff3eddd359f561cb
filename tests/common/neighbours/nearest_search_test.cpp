#include "common/neighbours/nearest_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "common/neighbours/position_tree.h"

namespace relief {
namespace {

struct Neighbour {
  std::uint32_t slot;
  double squared;
};

/// All other positions as the rule orders them, found without any bound: by distance, those at
/// equal distances in the order in which the tree visits them.
std::vector<Neighbour> order_all(const PositionTree& tree, std::uint32_t slot) {
  std::vector<Neighbour> all;
  const glm::dvec3 from = tree.at(slot);
  tree.visit_near(
      from, [] { return std::numeric_limits<double>::infinity(); },
      [&](std::size_t first, std::size_t count) {
        for (std::size_t s = first; s < first + count; ++s) {
          const glm::dvec3 d = from - tree.at(s);
          if (s != slot)
            all.push_back({static_cast<std::uint32_t>(s), d.x * d.x + d.y * d.y + d.z * d.z});
        }
      });
  std::stable_sort(all.begin(), all.end(),
                   [](const Neighbour& a, const Neighbour& b) { return a.squared < b.squared; });
  return all;
}

/// That every search, one after another, finds the first k of all others.
void expect_first_of_all(const std::vector<glm::dvec3>& positions, std::uint32_t k) {
  const PositionTree tree(positions);
  NearestSearch nearest(tree, k);
  for (std::uint32_t slot = 0; slot < tree.size(); ++slot) {
    const std::vector<Neighbour> all = order_all(tree, slot);
    ASSERT_EQ(all.size() + 1, positions.size());
    nearest.find(slot);
    for (std::uint32_t m = 0; m < k; ++m) {
      ASSERT_EQ(nearest.slot(m), all[m].slot) << "neighbour " << m << " of slot " << slot;
      ASSERT_EQ(nearest.squared(m), all[m].squared);
    }
  }
}

/// A 40 x 40 grid: up to eight neighbours at one distance.
std::vector<glm::dvec3> grid() {
  std::vector<glm::dvec3> positions;
  for (int i = 0; i < 40; ++i) {
    for (int j = 0; j < 40; ++j) positions.emplace_back(i, j, 0.0);
  }
  return positions;
}

TEST(NearestSearch, FindsTheNearest) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> inside(-1.0, 1.0);
  std::vector<glm::dvec3> positions;
  for (int k = 0; k < 2000; ++k)
    positions.emplace_back(inside(random), inside(random), 1e-3 * inside(random));
  // A second cluster far away: the bound from the search before is wide there.
  for (int k = 0; k < 300; ++k)
    positions.emplace_back(1e3 + 1e-6 * inside(random), 1e-6 * inside(random), 0.0);
  expect_first_of_all(positions, 16);
  expect_first_of_all(positions, 1);
}

TEST(NearestSearch, TakesTheFirstVisitedOfThoseAtOneDistance) {
  expect_first_of_all(grid(), 16);
  expect_first_of_all(grid(), 6);
}

// Patch files depend on it. The value is that of nanoflann 1.4.2's knnSearch, which chose the
// neighbours of all patch files before this tree did.
TEST(NearestSearch, TakesTheNeighboursOfEarlierVersions) {
  const PositionTree tree(grid());
  NearestSearch nearest(tree, 16);
  std::vector<std::uint32_t> neighbours(std::size_t{16} * tree.size());
  for (std::uint32_t slot = 0; slot < tree.size(); ++slot) {
    nearest.find(slot);
    for (std::uint32_t m = 0; m < 16; ++m)
      neighbours[16 * tree.index(slot) + m] = tree.index(nearest.slot(m));
  }
  std::uint64_t checksum = 14695981039346656037U;  // FNV-1a
  for (const std::uint32_t index : neighbours) checksum = (checksum ^ index) * 1099511628211U;
  EXPECT_EQ(checksum, 6550970137418880459U);
}

// More at one position than neighbours are asked for: the bound is 0 then.
TEST(NearestSearch, FindsDuplicates) {
  std::vector<glm::dvec3> positions(200, glm::dvec3(3.0, 4.0, 5.0));
  for (int i = 0; i < 20; ++i) positions.emplace_back(i, 0.0, 0.0);
  expect_first_of_all(positions, 16);
  expect_first_of_all(std::vector<glm::dvec3>(100, glm::dvec3(-1.0)), 99);
}

TEST(NearestSearch, FindsAllOthersOfFewPositions) {
  expect_first_of_all({{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}}, 1);
  std::vector<glm::dvec3> positions;
  for (int i = 0; i < 17; ++i) positions.emplace_back(i, i % 3, 0.0);  // one more than a leaf has
  expect_first_of_all(positions, 16);
}

// Each split takes one position off.
TEST(NearestSearch, FindsTheNearestInADeepTree) {
  std::vector<glm::dvec3> positions;
  for (int i = 0; i < 900; ++i) positions.emplace_back(std::ldexp(1.0, i - 450), 0.0, 0.0);
  expect_first_of_all(positions, 4);
}

}  // namespace
}  // namespace relief
