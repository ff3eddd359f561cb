// Adds points to mesh triangles that are larger than the mesh's spacing.
#pragma once

#include <cstddef>

#include "common/points.h"

namespace relief {

/// Adds points on edges and triangles that span more than 2.5 mean spacings, about one spacing
/// apart, so that large triangles do not become gaps. Interpolates attributes. The mean spacing is
/// sqrt(area / points). Adds at most four points per given point; if that is not enough (meshes of
/// needles), all are farther apart. The added points follow the given ones and have no triangles.
/// Returns their number.
std::size_t densify_triangles(Points& points);

}  // namespace relief
