// Normal maps as functions: what is stored, what its means are, and what stands for no direction.
#include "common/mesh/normal_texture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "common/image/image_formats.h"
#include "common/image/image_io.h"
#include "common/image/srgb.h"

namespace relief {
namespace {

/// 16 bits round a component by half of 1 / 32767.
constexpr float kTexelRounding = 2e-5F;

Image image_of_pixels(const std::vector<glm::vec3>& pixels) {
  Image image{static_cast<std::uint32_t>(pixels.size()), 1, {}};
  for (glm::length_t c = 0; c < 3; ++c) {
    image.channels.push_back({std::string(1, "RGB"[c]), ChannelType::Float, {}});
    for (const glm::vec3 pixel : pixels) image.channels.back().values.push_back(pixel[c]);
  }
  return image;
}

void expect_normal_near(glm::vec3 found, glm::vec3 expected) {
  for (glm::length_t c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], kTexelRounding) << c;
}

TEST(NormalTexture, ZeroToOneIsMinusOneToOne) {
  // 0.6 and 0.8 are a right triangle's, and the second pixel is as long again.
  const auto texture = NormalTexture::from_image(
      image_of_pixels({{0.8F, 0.5F, 0.9F}, {0.5F, 0.1F, 1.1F}}), TextureWrap::Clamp);
  ASSERT_TRUE(texture);
  expect_normal_near(texture->at({0.25F, 0.5F}), {0.6F, 0.0F, 0.8F});
  expect_normal_near(texture->at({0.75F, 0.5F}), glm::normalize(glm::vec3(0.0F, -0.8F, 1.2F)));
}

TEST(NormalTexture, WhatHasNoDirectionIsFlatAndNoneLeavesTheSurface) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinite = std::numeric_limits<float>::infinity();
  Image image = image_of_pixels({{nan, 0.5F, 1.0F},
                                 {0.5F, infinite, 0.5F},
                                 {0.5F, 0.5F, 0.5F},
                                 {1.0F, 0.5F, 0.0F},
                                 {0.2F, 0.7F, 0.9F}});
  image.channels.push_back({"A", ChannelType::Float, {1.0F, 1.0F, 1.0F, 1.0F, 0.0F}});
  const auto texture = NormalTexture::from_image(image, TextureWrap::Clamp);
  ASSERT_TRUE(texture);
  for (const float u : {0.1F, 0.3F, 0.5F, 0.9F})
    expect_normal_near(texture->at({u, 0.5F}), {0.0F, 0.0F, 1.0F});
  // Blue below a half points into the surface: no farther than along it.
  expect_normal_near(texture->at({0.7F, 0.5F}), {1.0F, 0.0F, 0.0F});
  image.channels.erase(image.channels.begin());
  EXPECT_FALSE(NormalTexture::from_image(image, TextureWrap::Clamp));
  EXPECT_FALSE(NormalTexture::from_image(image_of_pixels({}), TextureWrap::Clamp));
}

TEST(NormalTexture, MeansAreShorterWhereNormalsSpread) {
  std::vector<glm::vec3> ridges;
  for (int k = 0; k < 64; ++k) ridges.emplace_back(k % 2 == 0 ? 0.8F : 0.2F, 0.5F, 0.9F);
  const auto texture = NormalTexture::from_image(image_of_pixels(ridges), TextureWrap::Repeat);
  ASSERT_TRUE(texture);
  expect_normal_near(texture->mean({0.4F, 0.5F}, {1.0F, 0.0F}, {0.0F, 1.0F}), {0.0F, 0.0F, 0.8F});
}

TEST(NormalTexture, StoredNumbersAreNotTurnedIntoLight) {
  // Written as colours whose codes are these.
  std::vector<glm::vec3> light;
  for (const std::uint8_t code : {0, 1, 77, 128, 255}) light.emplace_back(linear_from_srgb8(code));
  const auto png = encode_png(image_of_pixels(light));
  ASSERT_TRUE(png);
  const auto image = decode_image("a.png", *png, Transfer::None);
  ASSERT_TRUE(image);
  const std::vector<float> expected{0.0F, 1.0F / 255.0F, 77.0F / 255.0F, 128.0F / 255.0F, 1.0F};
  EXPECT_EQ(image->find("G")->values, expected);
}

}  // namespace
}  // namespace relief
