// Thins dense scans: `relief convert --thin`.
#pragma once

#include <cstdint>

#include "common/points.h"

namespace relief {

/// Keeps one point in each cube of side `spacing` (world units, above 0; cubes at its multiples):
/// the one nearest to the mean of the cube's points, the first of equals. Triangles at removed
/// points are dropped. Returns the number of removed points. The result depends neither on threads
/// nor on points of other cubes.
std::uint64_t thin_points(Points& points, double spacing);

}  // namespace relief
