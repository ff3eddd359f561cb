// Points on the triangles of a mesh that are larger than its spacing.
#pragma once

#include <cstddef>

#include "common/points.h"

namespace relief {

/// Adds points on edges and triangles that span more than 2.5 mean spacings, about one apart, so
/// that what a mesh says is surface does not become a gap. Attributes are interpolated. The mean
/// spacing is sqrt(area / points). At most four points are added per point given: where that is not
/// enough (meshes of needles) all of them are farther apart. They stand behind the given ones,
/// without triangles. Returns how many were added.
std::size_t densify_triangles(Points& points);

}  // namespace relief
