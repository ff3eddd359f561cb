// The texels of a patch's maps about its nodes.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>

#include "common/patch.h"

namespace relief {

/// Values of texels, added up, and how many they are.
struct TexelSum {
  glm::vec3 sum{0.0F};
  float count = 0.0F;
};

/// The sum of `value`, which makes a texel a glm::vec3, over a node's own square: a cell large, at
/// the edges of the patch as much of it as the map has.
template <class Texel, class Value>
[[nodiscard]] TexelSum sum_about_node(const AttributeMap<Texel>& map, std::uint32_t i,
                                      std::uint32_t j, const Value& value) {
  const std::uint32_t x = i * map.scale;
  const std::uint32_t y = j * map.scale;
  const std::uint32_t half = map.scale / 2;
  const std::uint32_t left = x - std::min(half, x);
  const std::uint32_t right = std::min(x + half, map.width - 1);
  const std::uint32_t low = y - std::min(half, y);
  const std::uint32_t high = std::min(y + half, map.height - 1);
  TexelSum out;
  for (std::uint32_t b = low; b <= high; ++b) {
    for (std::uint32_t a = left; a <= right; ++a)
      out.sum += value(map.texels[std::size_t{b} * map.width + a]);
  }
  out.count = static_cast<float>((right - left + 1) * (high - low + 1));
  return out;
}

}  // namespace relief
