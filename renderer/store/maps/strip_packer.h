// Rectangles packed into a strip.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

namespace relief {

struct PackedStrip {
  std::vector<glm::uvec2> corners;  ///< of each rectangle, the lowest
  std::uint32_t height = 0;
};

/// Packs rectangles, none wider than the strip: highest first, each where its top is lowest, then
/// leftmost, on the skyline of those before (Jylanki, "A Thousand Ways to Pack the Bin", 2010,
/// section 3.1). The maps of 60 million points leave a sixth of the strip empty; in shelves they
/// left a third to a half.
[[nodiscard]] PackedStrip pack_strip(std::span<const glm::uvec2> sizes, std::uint32_t width);

}  // namespace relief
