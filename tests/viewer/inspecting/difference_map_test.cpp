#include "viewer/inspecting/difference_map.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/image/srgb.h"
#include "viewer/inspecting/inspection_colours.h"

namespace relief {
namespace {

/// All pixels of one sRGB value of 8 bits.
Image image_of(std::uint32_t width, std::uint32_t height, std::uint8_t value) {
  Image image{width, height, {}};
  for (const char* const name : {"R", "G", "B"}) {
    image.channels.push_back(
        {name, ChannelType::Float,
         std::vector<float>(std::size_t{width} * height, linear_from_srgb8(value))});
  }
  return image;
}

glm::u8vec3 rgb(glm::u8vec4 pixel) {
  return {pixel.r, pixel.g, pixel.b};
}

TEST(DifferenceMap, HasTheStepsOfEachPixel) {
  const Image truth = image_of(3, 2, 100);
  Image shown = truth;
  shown.channels[1].values[0] = linear_from_srgb8(124);  // upper left, green
  shown.channels[2].values[5] = linear_from_srgb8(20);   // lower right, blue
  const auto map = map_difference(shown, truth, 0.0);
  ASSERT_TRUE(map) << map.error().message;
  ASSERT_EQ(map->pixels.size(), 6U);
  EXPECT_EQ(rgb(map->pixels[3]), colour_at(kDifferenceMap, 0.8));
  EXPECT_EQ(rgb(map->pixels[2]), colour_at(kDifferenceMap, 1.0));
  EXPECT_EQ(rgb(map->pixels[0]), colour_at(kDifferenceMap, 0.0));
  // 18 values, two of which are off.
  const double mean = (24.0 * 24.0 + 80.0 * 80.0) / (255.0 * 255.0) / 18.0;
  EXPECT_NEAR(map->psnr_db, -10.0 * std::log10(mean), 0.01) << "floats of linear light";
}

TEST(DifferenceMap, IsInfiniteWithoutADifference) {
  const Image image = image_of(2, 2, 7);
  const auto map = map_difference(image, image, 1.0);
  ASSERT_TRUE(map);
  EXPECT_TRUE(std::isinf(map->psnr_db));
}

TEST(DifferenceMap, IsSeenWithTheExposure) {
  const auto plain = map_difference(image_of(1, 1, 10), image_of(1, 1, 20), 0.0);
  const auto brighter = map_difference(image_of(1, 1, 10), image_of(1, 1, 20), 3.0);
  ASSERT_TRUE(plain && brighter);
  EXPECT_LT(brighter->psnr_db, plain->psnr_db);
}

TEST(DifferenceMap, RefusesAnotherSize) {
  const auto map = map_difference(image_of(2, 2, 7), image_of(2, 3, 7), 0.0);
  ASSERT_FALSE(map);
  EXPECT_EQ(map.error().message, "has 2x2 pixels, and the truth 2x3");
}

TEST(DifferenceMap, JoinsTwoLooksAtTheDivider) {
  const Image joined = join_at(image_of(4, 1, 0), image_of(4, 1, 255), 0.5);
  EXPECT_EQ(joined.channels[0].values, (std::vector<float>{0.0F, 0.0F, 1.0F, 1.0F}));
}

}  // namespace
}  // namespace relief
