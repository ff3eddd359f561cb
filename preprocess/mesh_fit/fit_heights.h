// Fits a patch's heights to the triangles of a mesh.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/patch.h"
#include "preprocess/texture/maps/flat_triangles.h"

namespace relief {

/// Texels per cell of the triangles that a fit asks for: one at each node, each edge's middle and
/// each cell's.
inline constexpr std::uint32_t kFitTexelsPerCell = 2;

/// Moves the samples of a patch so that its surface is nearest to the triangles (least squares of
/// the heights at nodes and half-way between them), rather than between their corners: a surface
/// through points of a curved mesh lies inside it. Samples under no triangle keep their heights.
///
/// `triangles`: those over the patch. `shown`: which of them its surface shows (find_shown, with
/// kFitTexelsPerCell). The origin may move along the patch's normal, and the triangles' heights
/// above it with it.
void fit_heights(std::vector<FlatTriangle>& triangles, std::span<const std::uint32_t> shown,
                 Patch& patch);

}  // namespace relief
