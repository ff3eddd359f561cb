// Heights as a patch keeps them.
#pragma once

#include <span>

#include "common/patch.h"

namespace relief {

/// Rounds the heights of a patch's samples to indices from the lowest sample's up, and returns that
/// height, to which the origin must be moved. Nodes at which `patch.heights` has kHole keep it;
/// one other at least is needed. `heights`: of all nodes, `step`: of an index; world units. Widens
/// the step if 16 bits would not hold the indices.
[[nodiscard]] double store_heights(std::span<const double> heights, double step, Patch& patch);

}  // namespace relief
