// Many small maps in the layers of one array texture.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

namespace relief {

/// Where a map lies in the array.
struct AtlasSpot {
  std::uint32_t x = 0;
  std::uint32_t y = 0;
  std::uint32_t layer = 0;
};

/// A packing of maps.
struct Atlas {
  glm::uvec2 size{1, 1};         ///< of a layer, texels
  std::uint32_t layers = 1;      ///< at least one, even without maps
  std::vector<AtlasSpot> spots;  ///< in the order of the maps
};

/// Packs maps of the given sizes in shelves, highest first; the same sizes give the same packing.
/// Spots and the layers' size are multiples of `block`: with mip levels up to log2(block) no texel
/// then belongs to two maps. Nothing if a map is wider or higher than `largest_side` or if more
/// than `most_layers` are needed.
[[nodiscard]] std::optional<Atlas> pack_atlas(const std::vector<glm::uvec2>& sizes,
                                              std::uint32_t largest_side, std::uint32_t most_layers,
                                              std::uint32_t block = 1);

/// `size` as a multiple of `block`, upward.
[[nodiscard]] inline glm::uvec2 whole_blocks(glm::uvec2 size, std::uint32_t block) {
  return (size + (block - 1U)) / block * block;
}

}  // namespace relief
