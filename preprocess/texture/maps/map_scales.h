// How fine the maps of patches are that were made of textured meshes.
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

/// The size in texels of the picture that a triangle of the mesh shows; 0: none.
using PictureSize = std::function<glm::dvec2(std::uint32_t triangle)>;

/// Nodes along a side of a patch to texels along that of its map.
[[nodiscard]] inline std::uint64_t map_side(std::uint32_t nodes, std::uint32_t scale) {
  return std::uint64_t{scale} * (nodes - 1) + 1;
}

/// Texels a cell of each patch's map: `texels_per_cell`, or where that is 0 the power of two that
/// keeps the texels of what its triangles show, together not more than 64 Mi texels (coarser
/// everywhere then); 1 where they show nothing. `triangles` are those over each patch. Fails, with
/// a clause, if as many as asked for are more than a patch or memory can hold.
Result<std::vector<std::uint32_t>> scales_of_maps(
    const Points& mesh, const std::vector<Patch>& patches,
    const std::vector<std::vector<FlatTriangle>>& triangles, const PictureSize& size_of,
    std::uint32_t texels_per_cell);

}  // namespace relief
