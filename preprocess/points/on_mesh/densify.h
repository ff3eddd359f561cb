// Adds points to mesh triangles that are larger than the mesh's spacing.
#pragma once

#include <cstddef>

#include "common/points.h"

namespace relief {

/// Adds points on edges and triangles that span more than 2.5 spacings, about one spacing apart, so
/// that large triangles do not become gaps. Interpolates attributes. The spacing is
/// sqrt(area / n), n the number of points or `at_least`. Adds at most 4 n points; if that is
/// not enough (meshes of needles), all are farther apart. The added points follow the given ones
/// and have no triangles. Returns their number.
std::size_t densify_triangles(Points& points, std::size_t at_least = 0);

}  // namespace relief
