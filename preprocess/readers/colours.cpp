#include "preprocess/readers/colours.h"

#include <algorithm>

namespace relief {

float find_colour_scale(const std::vector<glm::vec3>& as_read, ColourNumbers numbers) {
  float largest = 0.0F;
  // A comparison with NaN is false, so NaN never becomes the largest.
  for (const glm::vec3& c : as_read) {
    for (int i = 0; i < 3; ++i) largest = c[i] > largest ? c[i] : largest;
  }
  if (largest > 255.0F) return 255.0F / 65535.0F;
  return numbers == ColourNumbers::Real && largest <= 1.0F ? 255.0F : 1.0F;
}

std::vector<glm::u8vec3> to_colours(const std::vector<glm::vec3>& as_read, float scale) {
  const auto channel = [scale](float value) {
    const float scaled = value * scale + 0.5F;
    if (!(scaled > 0.0F)) return std::uint8_t{0};
    return static_cast<std::uint8_t>(std::min(scaled, 255.0F));
  };
  std::vector<glm::u8vec3> colours;
  colours.reserve(as_read.size());
  for (const glm::vec3& c : as_read) {
    colours.emplace_back(channel(c.x), channel(c.y), channel(c.z));
  }
  return colours;
}

std::vector<glm::u8vec3> to_colours(const std::vector<glm::vec3>& as_read, ColourNumbers numbers) {
  return to_colours(as_read, find_colour_scale(as_read, numbers));
}

}  // namespace relief
