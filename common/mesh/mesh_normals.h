// Normals of vertices from the triangles around them.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "common/points.h"

namespace relief {

/// Returns unit normals of all points: the mean of their triangles' normals, weighted by the angles
/// at the point (Thürmer and Wüthrich 1998). 0 for points without a triangle that has an area, and
/// for normals that cancel out.
[[nodiscard]] std::vector<glm::vec3> normals_from_triangles(const Points& points);

/// Returns unit normals of all points of a mesh: the given ones, or, for those that are missing, 0
/// or not finite, the means of their triangles. 0 if there is neither.
[[nodiscard]] std::vector<glm::vec3> vertex_normals(const Points& points);

}  // namespace relief
