#include "preprocess/texture/acquisition/continuous_texture.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/preprocess/texture/textures.h"

namespace relief::test {
namespace {

// Sums of floats near 1 with weights that are rounded to float.
constexpr float kTextureRounding = 1e-6F;

TEST(ContinuousTexture, AConstantStaysConstant) {
  const auto texture =
      ContinuousTexture::from_image(make_texture(8, [](double, double) { return 0.75; }));
  ASSERT_TRUE(texture);
  for (const double deviation : {1.0, 3.0, 8.0}) {
    for (float s = -1.3F; s < 2.0F; s += 0.37F) {
      EXPECT_NEAR(texture->at({s, 0.4F - s}, deviation).r, 0.75F, kTextureRounding);
    }
  }
}

TEST(ContinuousTexture, OneTexelIsAGaussianOfUnitVariance) {
  // Texel (10, 5) of 32 x 32 from the top: its middle is at u = 10.5 / 32, v = 1 - 5.5 / 32.
  Image image = make_texture(32, [](double, double) { return 0.0; });
  image.channels[0].values[5 * 32 + 10] = 1.0F;
  const auto texture = ContinuousTexture::from_image(image);
  ASSERT_TRUE(texture);
  for (const double x : {-2.0, -0.5, 0.0, 1.0, 2.5}) {
    for (const double y : {-1.5, 0.0, 0.7}) {
      const glm::vec2 texcoord((10.5 + x) / 32.0, 1.0 - (5.5 + y) / 32.0);
      const double expected = std::exp(-0.5 * (x * x + y * y)) / (2.0 * std::numbers::pi);
      // Cut at 4 deviations and made to sum to 1, the weights are off by a part in 10,000.
      EXPECT_NEAR(texture->at(texcoord).r, expected, 2e-4 * expected + 1e-7) << x << ", " << y;
    }
  }
}

TEST(ContinuousTexture, AWideGaussianDampsAWaveAsItsTransformSays) {
  const auto texture = ContinuousTexture::from_image(make_texture(64, Wave{4.0}));
  ASSERT_TRUE(texture);
  const double omega = 2.0 * std::numbers::pi * 4.0 / 64.0;  // radians a texel
  for (const double deviation : {1.0, 2.0, 4.0}) {
    const double amplitude = std::exp(-0.5 * deviation * deviation * omega * omega) / 2.0;
    // The tails that are cut hold 0.0001 of the weight.
    EXPECT_NEAR(texture->at({1.0F / 16.0F, 0.3F}, deviation).r, 0.5 + amplitude, 2e-4);
  }
}

TEST(ContinuousTexture, RepeatsOutsideTheUnitSquare) {
  const auto texture = ContinuousTexture::from_image(
      make_texture(16, [](double u, double v) { return u * u + 0.3 * v; }));
  ASSERT_TRUE(texture);
  const float inside = texture->at({0.125F, 0.75F}).r;
  EXPECT_NEAR(texture->at({3.125F, -4.25F}).r, inside, kTextureRounding);
  EXPECT_NEAR(texture->at({-0.875F, 7.75F}).r, inside, kTextureRounding);
  for (const float far : {-1e-30F, 1e30F, -1e38F}) {
    EXPECT_TRUE(std::isfinite(texture->at({far, far}).r)) << far;
  }
}

TEST(ContinuousTexture, OneTexelIsAConstant) {
  const auto texture =
      ContinuousTexture::from_image(make_texture(1, [](double, double) { return 0.5; }));
  ASSERT_TRUE(texture);
  EXPECT_NEAR(texture->at({0.9F, 0.1F}, 8.0).r, 0.5F, kTextureRounding);
}

TEST(ContinuousTexture, NanValuesCountAsZero) {
  Image image = make_texture(4, [](double, double) { return 0.0; });
  image.channels[0].values[3] = std::numeric_limits<float>::quiet_NaN();
  image.channels[0].values[7] = -std::numeric_limits<float>::infinity();
  const auto texture = ContinuousTexture::from_image(image);
  ASSERT_TRUE(texture);
  EXPECT_EQ(texture->at({0.9F, 0.9F}).r, 0.0F);
}

TEST(ContinuousTexture, SaysWhichChannelIsMissing) {
  Image image = make_texture(4, [](double, double) { return 0.0; });
  image.channels.pop_back();
  const auto texture = ContinuousTexture::from_image(image);
  ASSERT_FALSE(texture);
  EXPECT_EQ(texture.error().message, "the texture has no channel B; use one with R, G and B");
  EXPECT_FALSE(ContinuousTexture::from_image(Image{}));
}

}  // namespace
}  // namespace relief::test
