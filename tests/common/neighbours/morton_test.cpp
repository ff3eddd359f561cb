// Sorting positions along a curve.
#include "common/neighbours/morton.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <numeric>
#include <random>

namespace relief {
namespace {

TEST(Morton, InterleavesTheBitsOfThreeCoordinates) {
  const Bounds unit{{0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}};
  EXPECT_EQ(morton_code({0.0, 0.0, 0.0}, unit), 0U);
  // Halves set the highest bits: x below y below z.
  EXPECT_EQ(morton_code({0.5, 0.0, 0.0}, unit), std::uint64_t{1} << 57U);
  EXPECT_EQ(morton_code({0.0, 0.5, 0.0}, unit), std::uint64_t{1} << 58U);
  EXPECT_EQ(morton_code({0.0, 0.0, 0.5}, unit), std::uint64_t{1} << 59U);
  const double step = 1.0 / (1U << 20U);
  EXPECT_EQ(morton_code({5.0 * step, 3.0 * step, 0.0}, unit), 0b001010011U);
  EXPECT_EQ(morton_code({1.0, 1.0, 1.0}, unit), (std::uint64_t{1} << kMortonBits) - 1);
}

TEST(Morton, TakesPositionsOutsideForTheSidesAndNeedsNoExtent) {
  const Bounds unit{{0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}};
  EXPECT_EQ(morton_code({-3.0, 0.0, 0.0}, unit), 0U);
  EXPECT_EQ(morton_code({0.0, 0.0, 9.0}, unit), morton_code({0.0, 0.0, 1.0}, unit));
  const Bounds place{{7.0, 7.0, 7.0}, {7.0, 7.0, 7.0}};
  EXPECT_EQ(morton_code({7.0, 7.0, 7.0}, place), 0U);
}

TEST(Morton, WhatIsNearInTheListIsNearInSpace) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> anywhere(0.0, 1.0);
  std::vector<glm::dvec3> positions(4096);
  for (glm::dvec3& p : positions) p = {anywhere(random), anywhere(random), anywhere(random)};
  std::vector<std::uint64_t> codes;
  for (const glm::dvec3& p : positions) codes.push_back(morton_code(p, {{0, 0, 0}, {1, 1, 1}}));
  const std::vector<std::uint32_t> order = order_of(codes);
  double sum = 0.0;
  for (std::size_t k = 1; k < order.size(); ++k)
    sum += glm::distance(positions[order[k]], positions[order[k - 1]]);
  // The mean distance of neighbours in space is 0.035, of any two positions 0.66.
  EXPECT_LT(sum / 4095.0, 0.1);
}

TEST(Morton, OrderIsThatOfAStableSort) {
  std::mt19937_64 random(5);
  // Of few bits, so that many are equal; of all bits; and none.
  for (const unsigned bits : {3U, 30U, 64U}) {
    for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{5000}}) {
      std::vector<std::uint64_t> codes(count);
      for (std::uint64_t& code : codes) code = random() >> (64U - bits);
      std::vector<std::uint32_t> expected(count);
      std::iota(expected.begin(), expected.end(), 0U);
      std::ranges::stable_sort(expected, {}, [&](std::uint32_t k) { return codes[k]; });
      EXPECT_EQ(order_of(codes), expected) << bits << ' ' << count;
    }
  }
}

}  // namespace
}  // namespace relief
