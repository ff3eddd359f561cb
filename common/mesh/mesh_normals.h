// Normals of vertices from the triangles around them.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "common/points.h"

namespace relief {

/// Unit normals of all points, the mean of their triangles' weighted by the angles at the point
/// (Thürmer and Wüthrich 1998); 0 where there is no triangle with an area, or where they cancel
/// out.
[[nodiscard]] std::vector<glm::vec3> normals_from_triangles(const Points& points);

/// Unit normals of all points of a mesh: the given ones, or where they are missing, 0 or no numbers
/// those above; 0 where that leaves none.
[[nodiscard]] std::vector<glm::vec3> vertex_normals(const Points& points);

}  // namespace relief
