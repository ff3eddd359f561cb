// Chooses the resolution of the maps of patches from textured meshes.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <vector>

#include "common/error.h"
#include "common/patch.h"
#include "common/points.h"
#include "preprocess/texture/maps/flat_triangles.h"

namespace relief {

/// The finest resolution. Finer textures have more detail than an image of a whole patch shows.
inline constexpr std::uint32_t kMaxTexelsPerCell = 64;

/// Returns the size in texels of the image of a triangle's texture; 0 without one.
using TextureSize = std::function<glm::dvec2(std::uint32_t triangle)>;

/// Returns the texels along a side of a map, from the nodes along that side of its patch.
[[nodiscard]] inline std::uint64_t map_side(std::uint32_t nodes, std::uint32_t scale) {
  return std::uint64_t{scale} * (nodes - 1) + 1;
}

/// Returns the texels per cell of each patch's map: `texels_per_cell`, or if that is 0 the power of
/// two that keeps the resolution of its triangles' textures; 1 without textures. All maps together
/// have at most 64 Mi texels; all become coarser if necessary. `triangles` are those over each
/// patch. Fails, with a clause, if the requested texels exceed a patch's limit or memory.
Result<std::vector<std::uint32_t>> scales_of_maps(
    const Points& mesh, const std::vector<Patch>& patches,
    const std::vector<std::vector<FlatTriangle>>& triangles, const TextureSize& size_of,
    std::uint32_t texels_per_cell);

}  // namespace relief
