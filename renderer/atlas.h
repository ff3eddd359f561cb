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
/// Nothing if one is wider or higher than `largest_side` or if more than `most_layers` are needed.
[[nodiscard]] std::optional<Atlas> pack_atlas(const std::vector<glm::uvec2>& sizes,
                                              std::uint32_t largest_side,
                                              std::uint32_t most_layers);

}  // namespace relief
