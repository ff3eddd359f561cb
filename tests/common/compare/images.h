// Small images for the tests of common/compare/.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "common/compare/compare.h"
#include "common/image/image.h"

namespace relief::test {

using ColourAt = std::function<glm::vec3(int x, int y)>;
using ValueAt = std::function<float(int x, int y)>;

/// Adds a channel, or fills the one of that name again.
inline void set_channel(Image& image, const std::string& name, const ValueAt& value) {
  std::vector<float> values;
  for (int y = 0; y < static_cast<int>(image.height); ++y) {
    for (int x = 0; x < static_cast<int>(image.width); ++x) values.push_back(value(x, y));
  }
  for (Channel& channel : image.channels) {
    if (channel.name == name) {
      channel.values = values;
      return;
    }
  }
  image.channels.push_back({name, ChannelType::Float, values});
}

/// An image with R, G and B, linear.
inline Image image_of(std::uint32_t width, std::uint32_t height, const ColourAt& colour) {
  Image image{width, height, {}};
  set_channel(image, "R", [&](int x, int y) { return colour(x, y).x; });
  set_channel(image, "G", [&](int x, int y) { return colour(x, y).y; });
  set_channel(image, "B", [&](int x, int y) { return colour(x, y).z; });
  return image;
}

inline Image grey_image(std::uint32_t width, std::uint32_t height, float light = 0.25F) {
  return image_of(width, height, [light](int, int) { return glm::vec3(light); });
}

/// FLIP of two images with colour.
inline Flip must_flip(const Image& test, const Image& reference, FlipRange range,
                      double pixels_per_degree = kFlipPixelsPerDegree) {
  Progress progress;
  auto flip = measure_flip(*take_colour(test), *take_colour(reference), {range, pixels_per_degree},
                           progress);
  EXPECT_TRUE(flip) << flip.error().message;
  return flip ? *flip : Flip{};
}

/// Compares what can be compared; FLIP as for a display.
inline Comparison must_compare(const Image& test, const Image& reference) {
  Progress progress;
  auto comparison = compare_images(test, reference, {FlipRange::Ldr}, progress);
  if (!comparison) throw std::runtime_error(comparison.error().message);
  return *comparison;
}

}  // namespace relief::test
