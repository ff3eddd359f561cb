#include "renderer/eye_dome.h"

#include <gtest/gtest.h>

#include <limits>

namespace relief {
namespace {

constexpr float kNothing = std::numeric_limits<float>::infinity();

/// A white image whose left half lies at one depth and whose right half at another.
Image two_halves(std::uint32_t size, float left, float right) {
  Image image{size, size, {}};
  for (const char* name : {"R", "G", "B", "A", "Z"}) {
    Channel channel{name, ChannelType::Float, {}};
    for (std::uint32_t i = 0; i < size * size; ++i) {
      const float depth = i % size < size / 2 ? left : right;
      channel.values.push_back(channel.name == "Z" ? depth : 1.0F);
    }
    image.channels.push_back(std::move(channel));
  }
  return image;
}

float at(const Image& image, const char* channel, std::uint32_t x) {
  return image.find(channel)->values[std::size_t{image.height / 2} * image.width + x];
}

TEST(EyeDome, DarkensWhatIsBehindItsNeighbours) {
  Image image = two_halves(64, 1.0F, 1.1F);
  shade_eye_dome(image, Camera{}, 1.0);
  EXPECT_EQ(at(image, "R", 31), 1.0F) << "what is in front";
  EXPECT_LT(at(image, "G", 32), 0.01F) << "beside the step, behind it";
  EXPECT_EQ(at(image, "B", 34), 1.0F) << "away from the step";
  EXPECT_EQ(at(image, "A", 32), 1.0F);
}

TEST(EyeDome, DependsOnTheRatioOfDepthsOnly) {
  Image near = two_halves(64, 1.0F, 1.001F);
  Image far = two_halves(64, 1000.0F, 1001.0F);
  shade_eye_dome(near, Camera{}, 1.0);
  shade_eye_dome(far, Camera{}, 1.0);
  // Depths of single precision: their ratio is off by 6e-8, a factor of 300 times that remains.
  EXPECT_NEAR(at(near, "R", 32), at(far, "R", 32), 1e-4F);
  EXPECT_LT(at(near, "R", 32), 0.9F);
}

TEST(EyeDome, LeavesTheBackgroundAndWhatStandsBeforeIt) {
  Image image = two_halves(64, 1.0F, kNothing);
  shade_eye_dome(image, Camera{}, 1.0);
  EXPECT_EQ(at(image, "R", 31), 1.0F);
  EXPECT_EQ(at(image, "R", 32), 1.0F);
}

TEST(EyeDome, OfAnOrthographicImageShadesStepsAlikeAtAnyDepth) {
  Camera camera;
  camera.orthographic_height = 2.0;
  Image near = two_halves(64, 0.0F, 0.01F);
  Image far = two_halves(64, 64.0F, 64.01F);
  shade_eye_dome(near, camera, 1.0);
  shade_eye_dome(far, camera, 1.0);
  // 64.01 is off by 3e-6, which 300 / (1.2 * 2 * ln 2) makes 5e-4 of the exponent.
  EXPECT_NEAR(at(near, "R", 32), at(far, "R", 32), 1e-3F);
  EXPECT_LT(at(near, "R", 32), 0.9F);
}

}  // namespace
}  // namespace relief
