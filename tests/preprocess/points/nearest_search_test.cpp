#include "preprocess/points/nearest_search.h"

#include <gtest/gtest.h>

#include <random>
#include <string>

#include "preprocess/points/position_tree.h"

namespace relief {
namespace {

/// That every search finds what nanoflann finds, in its order.
void expect_as_nanoflann(const std::vector<glm::dvec3>& positions, std::uint32_t k) {
  const PositionsAdaptor adaptor{positions};
  const PositionTree tree(3, adaptor, nanoflann::KDTreeSingleIndexAdaptorParams(kTreeLeafSize));
  const LeafPositions leaves(tree, positions);
  NearestSearch nearest(tree, leaves, k);
  std::vector<std::uint32_t> found(k + 1);
  std::vector<double> squared(k + 1);
  for (std::uint32_t place = 0; place < positions.size(); ++place) {
    const std::uint32_t i = tree.vAcc[place];
    nearest.find(place);
    ASSERT_EQ(tree.knnSearch(&positions[i].x, k + 1, found.data(), squared.data()), k + 1);
    for (std::uint32_t m = 0, kept = 0; m <= k && kept < k; ++m) {
      if (found[m] == i) continue;
      ASSERT_EQ(tree.vAcc[nearest.place(kept)], found[m]) << "neighbour " << kept << " of " << i;
      ASSERT_EQ(nearest.squared(kept), squared[m]);
      ++kept;
    }
  }
}

TEST(NearestSearch, FindsWhatNanoflannFinds) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> inside(-1.0, 1.0);
  std::vector<glm::dvec3> positions;
  for (int k = 0; k < 2000; ++k)
    positions.emplace_back(inside(random), inside(random), 1e-3 * inside(random));
  // A second cluster far away: the bound from the search before is wide there.
  for (int k = 0; k < 300; ++k)
    positions.emplace_back(1e3 + 1e-6 * inside(random), 1e-6 * inside(random), 0.0);
  expect_as_nanoflann(positions, 16);
  expect_as_nanoflann(positions, 1);
}

// A grid has up to eight neighbours at one distance, and only the order of the search chooses.
TEST(NearestSearch, TakesTheSameOfThoseAtOneDistance) {
  std::vector<glm::dvec3> positions;
  for (int i = 0; i < 40; ++i) {
    for (int j = 0; j < 40; ++j) positions.emplace_back(i, j, 0.0);
  }
  expect_as_nanoflann(positions, 16);
  expect_as_nanoflann(positions, 6);
}

// More at one place than neighbours are asked for: the bound is 0 then.
TEST(NearestSearch, FindsThoseAtItsOwnPlace) {
  std::vector<glm::dvec3> positions(200, glm::dvec3(3.0, 4.0, 5.0));
  for (int i = 0; i < 20; ++i) positions.emplace_back(i, 0.0, 0.0);
  expect_as_nanoflann(positions, 16);
}

}  // namespace
}  // namespace relief
