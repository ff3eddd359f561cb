// A tile's splats, composited front to back [Zwicker 2002, Eq. (7) and (10)].
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <span>
#include <vector>

#include "renderer/volume/kernel_cloud.h"
#include "renderer/volume/settings.h"
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

/// How layers are composited.
struct CompositeRule {
  KernelWeight weight = KernelWeight::Integral;
  Attenuation attenuation = Attenuation::Linear;
  double min_alpha = 0.0;           ///< of a contribution
  double max_alpha = 1.0;           ///< likewise
  double min_transmittance = 1e-6;  ///< where a pixel ends
};

[[nodiscard]] CompositeRule composite_rule(const VolumeSettings& settings, KernelWeight weight);

/// What is drawn, for all tiles.
struct Composition {
  std::span<const PlacedSplat> splats;
  std::span<const glm::vec3> colours;  ///< of each kernel, as it is blended
  std::span<const glm::vec3> normals;  ///< of each kernel, or none
  const SplatOrder& order;
  CompositeRule rule;
  Tiling tiling;
};

/// Composites a tile into kTile * kTile pixels, row by row from the top. Returns the evaluations of
/// footprints.
std::uint64_t composite_tile(const Composition& composition, const TileLists& lists,
                             std::size_t tile, std::span<VolumePixel> pixels);

}  // namespace relief::volume_reference
