// Kernels become splats of an image.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "renderer/engines/volume/cpu/distant_lights.h"
#include "renderer/engines/volume/cpu/grid_projection.h"
#include "renderer/engines/volume/cpu/tiles.h"
#include "renderer/engines/volume/drawing.h"
#include "renderer/volume/splats/ray_space.h"

namespace relief::volume::cpu {

/// Places the kernels of a frame. Those of a grid, which have one variance, in single precision and
/// kLanes at once; others as volume-reference does.
class Placer {
 public:
  explicit Placer(const VolumeFrame& frame);

  /// Adds what may be seen of some kernels of a group where `tiles` are open. Thread-safe.
  void place(std::span<const std::uint32_t> kernels, std::uint32_t group, const Tiles& tiles,
             Piece& piece) const;

 private:
  void place_each(std::span<const std::uint32_t> kernels, std::uint32_t group, const Tiles& tiles,
                  Piece& piece) const;
  void place_lanes(const GridProjection& grid, std::span<const std::uint32_t> kernels,
                   std::uint32_t group, const Tiles& tiles, Piece& piece) const;
  /// Of the first kLanes kernels; those that are not seen need none.
  [[nodiscard, gnu::always_inline]] Vectors colours_of(std::span<const std::uint32_t> kernels,
                                                       const Vectors& from_eye,
                                                       const Ints& is_seen) const;

  const VolumeFrame& frame_;
  RayCamera camera_;
  std::optional<Variance> in_camera_;   ///< of all kernels
  std::optional<GridProjection> grid_;  ///< where kernels are placed in lanes
};

}  // namespace relief::volume::cpu
