// Samples that lie off the mesh.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/patch.h"
#include "preprocess/texture/maps/flat_triangles.h"

namespace relief {

/// Makes samples holes that lie off all triangles of the mesh by more than 0.4 spacings.
/// They overhang: the triangles below them are another side's, seen edge-on or from behind.
/// Triangles with such a corner stick out of thin and sharp features. A patch of nothing else stays
/// as it is.
///
/// `triangles`: those over the patch; `shown`: by node which of them its surface shows; `mesh`: all
/// triangles, for samples above none.
void drop_stray_samples(const std::vector<FlatTriangle>& triangles,
                        std::span<const std::uint32_t> shown, const TriangleSpheres& mesh,
                        Patch& patch);

}  // namespace relief
