#include "common/neighbours/position_tree.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <limits>
#include <random>

#include "common/neighbours/radius_search.h"

namespace relief {
namespace {

std::vector<glm::dvec3> random_positions(int count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> inside(-1.0, 1.0);
  std::vector<glm::dvec3> positions;
  for (int i = 0; i < count; ++i)
    positions.emplace_back(inside(random), inside(random), inside(random));
  return positions;
}

TEST(PositionTree, HoldsEveryPositionInOneLeaf) {
  const std::vector<glm::dvec3> positions = random_positions(1000);
  const PositionTree tree(positions);
  ASSERT_EQ(tree.size(), positions.size());
  std::vector<int> visits(positions.size(), 0);
  tree.visit_near(
      glm::dvec3(5.0), [] { return std::numeric_limits<double>::infinity(); },
      [&](std::size_t first, std::size_t count) {
        EXPECT_GE(count, 1U);
        EXPECT_LE(count, PositionTree::kLeafSize);
        for (std::size_t slot = first; slot < first + count; ++slot) {
          EXPECT_EQ(tree.at(slot), positions[tree.index(slot)]);
          ++visits[tree.index(slot)];
        }
      });
  EXPECT_EQ(visits, std::vector<int>(positions.size(), 1));
}

// Sides of large splits are built in parallel, as trees of their own.
TEST(PositionTree, OfManyPositionsFindsThemAll) {
  const std::vector<glm::dvec3> positions = random_positions(50'000);
  const RadiusSearch search(positions);
  std::vector<std::uint32_t> found;
  for (const glm::dvec3 centre : {glm::dvec3(0.2), positions[3], glm::dvec3(-0.9, 0.0, 0.4)}) {
    std::vector<std::uint32_t> expected;
    for (std::uint32_t i = 0; i < positions.size(); ++i) {
      if (glm::distance(positions[i], centre) < 0.3) expected.push_back(i);
    }
    search.find(centre, 0.3, found);
    EXPECT_EQ(found, expected);
  }
}

TEST(PositionTree, OfNoPositionsHasNoLeaf) {
  const PositionTree tree({});
  EXPECT_EQ(tree.size(), 0U);
  tree.visit_near(
      glm::dvec3(0.0), [] { return std::numeric_limits<double>::infinity(); },
      [](std::size_t, std::size_t) { FAIL() << "a leaf of an empty tree"; });
}

TEST(PositionTree, LeavesOutWhatIsOutOfReach) {
  const PositionTree tree(random_positions(1000));
  std::size_t seen = 0;
  tree.visit_near(
      glm::dvec3(0.5), [] { return 0.01; }, [&](std::size_t, std::size_t count) { seen += count; });
  // A ball of radius 0.1 has 0.5 of 1000 positions in this cube, the leaves that it touches up to
  // 16 each.
  EXPECT_GE(seen, 1U);
  EXPECT_LE(seen, 8 * PositionTree::kLeafSize);
  tree.visit_near(
      glm::dvec3(5.0), [] { return 0.01; },
      [](std::size_t, std::size_t) { FAIL() << "a leaf out of reach"; });
}

TEST(RadiusSearch, AgreesWithBruteForce) {
  std::vector<glm::dvec3> positions = random_positions(1500);
  positions.insert(positions.end(), 40, glm::dvec3(0.25));  // duplicates: more than a leaf holds
  const RadiusSearch search(positions);
  std::vector<std::uint32_t> found{99};
  // Inside, on a position, outside of the box of all.
  for (const glm::dvec3 centre : {glm::dvec3(0.2), positions[3], glm::dvec3(1.3, 0.0, -2.0)}) {
    for (const double radius : {0.0, 0.2, 1.0, 10.0}) {
      std::vector<std::uint32_t> expected;
      for (std::uint32_t i = 0; i < positions.size(); ++i) {
        if (glm::distance(positions[i], centre) < radius) expected.push_back(i);
      }
      search.find(centre, radius, found);
      EXPECT_EQ(found, expected) << "radius " << radius;
    }
  }
}

TEST(RadiusSearch, LeavesOutWhatIsAtTheRadius) {
  const RadiusSearch search({{0.0, 0.0, 0.0}, {2.0, 0.0, 0.0}, {0.0, -2.0, 0.0}, {0.0, 1.5, 0.0}});
  std::vector<std::uint32_t> found;
  search.find(glm::dvec3(0.0), 2.0, found);
  EXPECT_EQ(found, (std::vector<std::uint32_t>{0, 3}));
}

TEST(RadiusSearch, EndsWithTheFirstThatIsWanted) {
  const RadiusSearch search(random_positions(1500));
  int looked_at = 0;
  EXPECT_TRUE(search.any(glm::dvec3(0.0), 1.0, [&](std::uint32_t) { return ++looked_at == 3; }));
  EXPECT_EQ(looked_at, 3);
  EXPECT_FALSE(search.any(glm::dvec3(0.0), 1.0, [](std::uint32_t) { return false; }));
  EXPECT_FALSE(search.any(glm::dvec3(3.0), 1.0, [](std::uint32_t) { return true; }));
}

TEST(RadiusSearch, FindsNothingAmongNoPositions) {
  const RadiusSearch search({});
  std::vector<std::uint32_t> found{1};
  search.find(glm::dvec3(0.0), 1.0, found);
  EXPECT_TRUE(found.empty());
}

}  // namespace
}  // namespace relief
