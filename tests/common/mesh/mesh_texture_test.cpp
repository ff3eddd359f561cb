// Textures as functions: constants stay, means are in linear light, edges wrap as requested.
#include "common/mesh/mesh_texture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "common/image/srgb.h"

namespace relief {
namespace {

MeshTexture constant(std::uint32_t width, std::uint32_t height, glm::u8vec3 colour) {
  return {width, height, std::vector<glm::u8vec3>(std::size_t{width} * height, colour),
          TextureWrap::Repeat};
}

TEST(MeshTexture, EveryGreyStaysAtEveryFootprint) {
  for (int grey = 0; grey < 256; ++grey) {
    const auto v = static_cast<std::uint8_t>(grey);
    // Odd sides, so that coarser levels have texels of three.
    const MeshTexture texture = constant(13, 7, glm::u8vec3(v));
    for (const float size : {0.01F, 0.3F, 2.0F, 50.0F}) {
      const glm::vec3 light = texture.mean({0.3F, 0.8F}, {size, 0.0F}, {0.1F, 0.2F});
      EXPECT_EQ(srgb8_from_linear(light.r), v) << size;
    }
  }
}

TEST(MeshTexture, MeansAreOfLightNotOfCodes) {
  std::vector<glm::u8vec3> checker;
  for (int k = 0; k < 64; ++k) checker.emplace_back((k + k / 8) % 2 == 0 ? 0 : 255);
  const MeshTexture texture(8, 8, checker, TextureWrap::Repeat);
  // Half the light; a level has it in 8 bits, half a step of which is 0.003 here.
  EXPECT_NEAR(texture.mean({0.4F, 0.4F}, {1.0F, 0.0F}, {0.0F, 1.0F}).g, 0.5F, 0.003F);
  // A footprint along only one axis: 8 taps at the finest level, half of them black.
  EXPECT_NEAR(texture.mean({0.5F, 0.5F}, {1.0F, 0.0F}, {0.0F, 0.001F}).g, 0.5F, 1e-5F);
}

TEST(MeshTexture, VGoesUpAndTexelsAreAtTheirMiddles) {
  const MeshTexture texture(1, 2, {{255, 0, 0}, {0, 255, 0}}, TextureWrap::Clamp);
  EXPECT_EQ(texture.at({0.5F, 0.75F}), glm::vec3(1.0F, 0.0F, 0.0F));
  EXPECT_EQ(texture.at({0.5F, 0.25F}), glm::vec3(0.0F, 1.0F, 0.0F));
  EXPECT_EQ(texture.at({0.5F, 0.5F}), glm::vec3(0.5F, 0.5F, 0.0F));
}

TEST(MeshTexture, WrapsAsRequested) {
  const std::vector<glm::u8vec3> texels{{255, 255, 255}, {0, 0, 0}};
  const MeshTexture repeated(2, 1, texels, TextureWrap::Repeat);
  const MeshTexture clamped(2, 1, texels, TextureWrap::Clamp);
  EXPECT_EQ(repeated.at({1.25F, 0.5F}).r, 1.0F);
  EXPECT_EQ(repeated.at({-0.25F, 0.5F}).r, 0.0F);
  EXPECT_EQ(repeated.at({0.0F, 0.5F}).r, 0.5F);
  EXPECT_EQ(clamped.at({1.25F, 0.5F}).r, 0.0F);
  EXPECT_EQ(clamped.at({0.0F, 0.5F}).r, 1.0F);
  for (const float far : {1e30F, -1e30F, std::numeric_limits<float>::max()}) {
    EXPECT_TRUE(std::isfinite(repeated.at({far, far}).r));
    EXPECT_TRUE(std::isfinite(clamped.mean({far, far}, {far, 0.0F}, {0.0F, far}).r));
  }
}

TEST(MeshTexture, TransparentPixelsAreNotBlack) {
  Image image{2,
              1,
              {{"R", ChannelType::Float, {0.25F, 0.0F}},
               {"G", ChannelType::Float, {0.25F, 0.0F}},
               {"B", ChannelType::Float, {0.25F, 0.0F}},
               {"A", ChannelType::Float, {0.5F, 0.0F}}}};
  const auto texture = MeshTexture::from_image(image, TextureWrap::Clamp);
  ASSERT_TRUE(texture);
  // Premultiplied 0.25 of opacity 0.5 is the colour 0.5, to half a step of 8 bits.
  EXPECT_NEAR(texture->at({0.25F, 0.5F}).r, 0.5F, 0.003F);
  EXPECT_NEAR(texture->at({0.75F, 0.5F}).r, 0.5F, 0.003F);
  image.channels[3].values = {0.0F, 0.0F};
  EXPECT_FALSE(MeshTexture::from_image(image, TextureWrap::Clamp));
  image.channels.pop_back();
  image.channels.pop_back();
  EXPECT_FALSE(MeshTexture::from_image(image, TextureWrap::Clamp));
  EXPECT_FALSE(MeshTexture::from_image({}, TextureWrap::Clamp));
}

}  // namespace
}  // namespace relief
