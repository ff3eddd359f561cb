// The sRGB transfer function (IEC 61966-2-1).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/ext/vector_uint3_sized.hpp>
#include <glm/vec3.hpp>

namespace relief {

/// Returns the linear light, in [0, 1], of an sRGB value in [0, 1].
[[nodiscard]] inline float linear_from_srgb(float s) {
  return s <= 0.04045F ? s / 12.92F : std::pow((s + 0.055F) / 1.055F, 2.4F);
}

/// Returns the linear light of an 8-bit sRGB value, from a table: images and scans have millions.
[[nodiscard]] inline float linear_from_srgb8(std::uint8_t value) {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> made{};
    for (std::size_t v = 0; v < made.size(); ++v)
      made[v] = linear_from_srgb(static_cast<float>(v) / 255.0F);
    return made;
  }();
  return table[value];
}

/// Returns the linear light of an 8-bit sRGB colour.
[[nodiscard]] inline glm::vec3 linear_from_srgb8(glm::u8vec3 colour) {
  return {linear_from_srgb8(colour.r), linear_from_srgb8(colour.g), linear_from_srgb8(colour.b)};
}

/// Returns the sRGB value, in [0, 1], of linear light, clamped to [0, 1]; NaN becomes 0.
[[nodiscard]] inline float srgb_from_linear(float l) {
  if (!(l > 0.0F)) return 0.0F;
  if (l >= 1.0F) return 1.0F;
  return l <= 0.0031308F ? l * 12.92F : 1.055F * std::pow(l, 1.0F / 2.4F) - 0.055F;
}

/// Returns the nearest 8-bit sRGB value of linear light.
[[nodiscard]] inline std::uint8_t srgb8_from_linear(float l) {
  return static_cast<std::uint8_t>(std::lround(srgb_from_linear(l) * 255.0F));
}

/// Returns the nearest 8-bit sRGB colour of linear light.
[[nodiscard]] inline glm::u8vec3 srgb8_from_linear(glm::vec3 light) {
  return {srgb8_from_linear(light.r), srgb8_from_linear(light.g), srgb8_from_linear(light.b)};
}

}  // namespace relief
