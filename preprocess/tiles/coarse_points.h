// A patch's samples as the points of a coarser scan.
#pragma once

#include "common/patch.h"
#include "common/points.h"

namespace relief {

/// A point for each two by two of a patch's nodes that have a sample: the means of the samples'
/// places, normals and colours (of linear light), so that what is finer than the new spacing, twice
/// the patch's, is averaged and not left out. World frame; has normals, and colours if the patch
/// has.
[[nodiscard]] Points coarse_points(const Patch& patch);

}  // namespace relief
