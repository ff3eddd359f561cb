// A tile's splats, composited front to back [Zwicker 2002, Eq. (7) and (10)].
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

#include "renderer/engines/volume_reference/tile_layers.h"
#include "renderer/engines/volume_reference/tile_pixels.h"
#include "renderer/volume/splats/composite_rule.h"
#include "renderer/volume/splats/tile_lists.h"

namespace relief::volume_reference {

/// What is composited, for all tiles.
struct Composition {
  std::span<const PlacedSplat> splats;
  std::span<const glm::vec3> colours;  ///< of each splat, as it is blended
  std::span<const glm::vec3> normals;  ///< of each kernel; none: the image has no normals
  bool has_depth = false;              ///< whether the image has depths
  const SplatOrder& order;
  CompositeRule rule;
  std::int64_t height = 0;  ///< of the image, pixels
};

/// Puts a tile's splats behind what its pixels show. `layers` are empty before and after. Returns
/// the evaluations of footprints.
std::uint64_t composite_tile(const Composition& composition, std::span<const OrderedSplat> list,
                             TileLayers& layers, TilePixels& pixels);

}  // namespace relief::volume_reference
