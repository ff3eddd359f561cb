// Measures the noise of a scan.
#pragma once

#include <vector>

#include "common/neighbours/position_tree.h"

namespace relief {

/// Estimates the standard deviation of the points' noise along the normal, world units, by slot of
/// the tree; 0 where there is none that can be told from detail.
///
/// Noise is what quadrics leave over whatever the size of their discs; what detail leaves over
/// grows with them. Where the discs are flat the noise is sure. Elsewhere, between what detail does
/// not explain and all that is left over, it is as near as can be to the scan's usual one, in
/// spacings. `spacing`: the scan's at the points, world units, by slot. The result does not depend
/// on the number of threads.
[[nodiscard]] std::vector<float> estimate_noise(const PositionTree& tree,
                                                const std::vector<float>& spacing);

}  // namespace relief
