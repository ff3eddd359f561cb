// Meshes whose points are repeated, for normals or texture coordinates, as one surface.
#pragma once

#include <vector>

#include "common/points.h"

namespace relief {

/// Returns the triangles with the first point of each position. Points that are not finite stay
/// apart, and corners that are no points stay as they are.
[[nodiscard]] std::vector<Triangle> welded_triangles(const Points& mesh);

}  // namespace relief
