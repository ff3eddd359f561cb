// A tile's splats, composited front to back [Zwicker 2002, Eq. (7) and (10)].
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <span>
#include <vector>

#include "renderer/volume/composite_rule.h"
#include "renderer/volume/tile_lists.h"

namespace relief::volume_reference {

/// What a pixel shows.
struct VolumePixel {
  glm::dvec3 colour{0.0};  ///< times its opacity
  double transmittance = 1.0;
  glm::dvec3 normal{0.0};  ///< world, any length
  /// Along the view axis: where half of what is behind is covered; infinite if nothing is.
  double depth = std::numeric_limits<double>::infinity();
};

/// What is drawn, for all tiles.
struct Composition {
  std::span<const PlacedSplat> splats;
  std::span<const glm::vec3> colours;  ///< of each kernel, as it is blended
  std::span<const glm::vec3> normals;  ///< of each kernel, or none
  const SplatOrder& order;
  CompositeRule rule;
  Tiling tiling;
};

/// Composites a tile into kTile * kTile pixels, row by row from the top. `limits`: likewise the depth
/// (along the view axis) where an opaque surface ends what a pixel shows, negative infinite where
/// nothing is to be drawn; empty: no surface anywhere. Returns the evaluations of footprints.
std::uint64_t composite_tile(const Composition& composition, const TileLists& lists,
                             std::size_t tile, std::span<const float> limits,
                             std::span<VolumePixel> pixels);

}  // namespace relief::volume_reference
