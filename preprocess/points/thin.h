// Fewer points where a scan is denser than it needs to be: `relief convert --thin`.
#pragma once

#include <cstdint>

#include "common/points.h"

namespace relief {

/// Leaves of the points in each cube of side `spacing` (world units, above 0; cubes at its
/// multiples) the one nearest to their mean, the first of equals; triangles at the others go.
/// Returns how many were taken away. Neither threads nor the points of other cubes change what
/// stays.
std::uint64_t thin_points(Points& points, double spacing);

}  // namespace relief
