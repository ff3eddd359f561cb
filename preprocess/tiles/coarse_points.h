// Makes the points of a coarser scan from a patch's samples.
#pragma once

#include <span>

#include "common/patch.h"
#include "common/points.h"
#include "common/scalar.h"

namespace relief {

/// Returns a point for each two by two nodes of a patch that have a sample: the mean of the
/// samples' positions, normals, colours (in linear light) and numbers, and of labels the most
/// frequent. Detail finer than the new spacing, twice the patch's, is averaged and not skipped.
/// World frame. The points have normals, colours if the patch has, and these scalars, which are the
/// patch's.
[[nodiscard]] Points coarse_points(const Patch& patch, std::span<const ScalarInfo> scalars = {});

}  // namespace relief
