// Makes the points of a coarser scan from a patch's samples.
#pragma once

#include "common/patch.h"
#include "common/points.h"

namespace relief {

/// Returns a point for each two by two nodes of a patch that have a sample: the mean of the
/// samples' positions, normals and colours (in linear light). Detail finer than the new spacing,
/// twice the patch's, is averaged and not skipped. World frame. The points have normals, and
/// colours if the patch has.
[[nodiscard]] Points coarse_points(const Patch& patch);

}  // namespace relief
