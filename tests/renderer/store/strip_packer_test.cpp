#include "renderer/store/maps/strip_packer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

namespace relief {
namespace {

void expect_apart(const std::vector<glm::uvec2>& sizes, const PackedStrip& packed,
                  std::uint32_t width) {
  std::vector<std::vector<bool>> taken(packed.height, std::vector<bool>(width, false));
  for (std::size_t r = 0; r < sizes.size(); ++r) {
    const glm::uvec2 corner = packed.corners[r];
    ASSERT_LE(corner.x + sizes[r].x, width) << r;
    ASSERT_LE(corner.y + sizes[r].y, packed.height) << r;
    for (std::uint32_t y = corner.y; y < corner.y + sizes[r].y; ++y) {
      for (std::uint32_t x = corner.x; x < corner.x + sizes[r].x; ++x) {
        ASSERT_FALSE(taken[y][x]) << r;
        taken[y][x] = true;
      }
    }
  }
}

TEST(StripPacker, PlacesLowRectanglesBesideHighOnes) {
  // The two low ones lie on each other beside the high one; a shelf would have one row for each.
  const std::vector<glm::uvec2> sizes{{6, 4}, {4, 10}, {6, 5}};
  const PackedStrip packed = pack_strip(sizes, 10);
  EXPECT_EQ(packed.height, 10U);
  EXPECT_EQ(packed.corners[1], glm::uvec2(0, 0));
  EXPECT_EQ(packed.corners[2], glm::uvec2(4, 0));
  EXPECT_EQ(packed.corners[0], glm::uvec2(4, 5));
}

TEST(StripPacker, OfNothingHasNoHeight) {
  EXPECT_EQ(pack_strip({}, 10).height, 0U);
}

/// How high the strip is if each row begins above the highest of the row before.
std::uint32_t height_in_shelves(std::vector<glm::uvec2> sizes, std::uint32_t width) {
  std::ranges::stable_sort(sizes, std::greater(), &glm::uvec2::y);
  std::uint32_t x = 0;
  std::uint32_t y = 0;
  std::uint32_t top = 0;
  for (const glm::uvec2 size : sizes) {
    if (x + size.x > width) {
      x = 0;
      y = top;
    }
    x += size.x;
    top = std::max(top, y + size.y);
  }
  return top;
}

TEST(StripPacker, LeavesLessEmptyThanShelves) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  // As those of patches: most are small.
  const auto side = [&] {
    return 2 + static_cast<std::uint32_t>(80.0 * std::pow(unit(random), 3));
  };
  double area = 0.0;
  double strips = 0.0;
  double shelves = 0.0;
  for (int round = 0; round < 100; ++round) {
    std::vector<glm::uvec2> sizes;
    for (int r = 0; r < 60; ++r) {
      sizes.emplace_back(side(), side());
      area += sizes.back().x * sizes.back().y;
    }
    const PackedStrip packed = pack_strip(sizes, 128);
    expect_apart(sizes, packed, 128);
    strips += 128.0 * packed.height;
    shelves += 128.0 * height_in_shelves(sizes, 128);
  }
  // 1.23 and 1.35 times the area.
  EXPECT_LT(strips, 1.27 * area);
  EXPECT_LT(strips, 0.95 * shelves);
}

}  // namespace
}  // namespace relief
