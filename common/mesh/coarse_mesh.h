// Meshes whose triangles say more than their points: of design programs, or of few triangles.
#pragma once

#include "common/points.h"

namespace relief {

/// The area of all triangles, world units squared.
[[nodiscard]] double area_of_triangles(const Points& mesh);

/// Whether most of a mesh's area lies in triangles that are large beside the distance of its
/// points, or in bodies of few points, so that these do not sample the surface. False without
/// triangles. Triangles with corners that are no points, or not finite, do not count.
[[nodiscard]] bool is_coarse_mesh(const Points& mesh);

}  // namespace relief
