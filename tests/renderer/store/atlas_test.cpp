#include "renderer/store/maps/atlas.h"

#include <gtest/gtest.h>

#include <random>

namespace relief {
namespace {

std::vector<glm::uvec2> random_sizes(std::size_t count, std::uint32_t largest) {
  std::mt19937 random(7);
  std::vector<glm::uvec2> sizes;
  for (std::size_t k = 0; k < count; ++k)
    sizes.emplace_back(1 + random() % largest, 1 + random() % largest);
  return sizes;
}

TEST(Atlas, MapsLieInsideAndApart) {
  const std::vector<glm::uvec2> sizes = random_sizes(200, 300);
  const auto atlas = pack_atlas(sizes, 16384, 2048);
  ASSERT_TRUE(atlas);
  for (std::size_t a = 0; a < sizes.size(); ++a) {
    const AtlasSpot& one = atlas->spots[a];
    EXPECT_LE(one.x + sizes[a].x, atlas->size.x);
    EXPECT_LE(one.y + sizes[a].y, atlas->size.y);
    EXPECT_LT(one.layer, atlas->layers);
    for (std::size_t b = 0; b < a; ++b) {
      const AtlasSpot& other = atlas->spots[b];
      const bool apart = one.layer != other.layer || one.x + sizes[a].x <= other.x ||
                         other.x + sizes[b].x <= one.x || one.y + sizes[a].y <= other.y ||
                         other.y + sizes[b].y <= one.y;
      EXPECT_TRUE(apart) << a << " and " << b;
    }
  }
}

TEST(Atlas, WastesLittle) {
  const std::vector<glm::uvec2> sizes = random_sizes(300, 120);
  std::uint64_t used = 0;
  for (const glm::uvec2 size : sizes) used += std::uint64_t{size.x} * size.y;
  const auto atlas = pack_atlas(sizes, 16384, 2048);
  ASSERT_TRUE(atlas);
  const std::uint64_t area = std::uint64_t{atlas->size.x} * atlas->size.y * atlas->layers;
  EXPECT_LT(area, used + used / 2);
}

TEST(Atlas, EmptyModelHasALayer) {
  const auto atlas = pack_atlas({}, 16384, 2048);
  ASSERT_TRUE(atlas);
  EXPECT_EQ(atlas->layers, 1U);
  EXPECT_GT(atlas->size.x * atlas->size.y, 0U);
}

TEST(Atlas, RefusesWhatOpenGlCannotHold) {
  EXPECT_FALSE(pack_atlas({{5000, 10}}, 4096, 2048));
  EXPECT_FALSE(pack_atlas(random_sizes(2000, 300), 2048, 2));
  EXPECT_TRUE(pack_atlas({{5000, 10}}, 5000, 1));
}

}  // namespace
}  // namespace relief
