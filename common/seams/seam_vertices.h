// Shares stitched triangles out among their patches.
#pragma once

#include <span>

#include "common/seams/border_mesh.h"
#include "common/seams/seams.h"

namespace relief {

/// The position half-way between two samples on the surface that their normals describe: on the
/// cubic through both [Vlachos 2001], or where their tangent planes meet if they turn by
/// more than a smooth surface does.
[[nodiscard]] glm::dvec3 seam_position(const BorderVertex& a, const BorderVertex& b);

/// Adds triangles between border vertices to `seams`. One with corners of several patches is cut
/// at seam vertices, one for each edge between two patches, so that each part is of one patch.
void share_out(std::span<const Triangle> triangles, const BorderMesh& mesh, Seams& seams);

}  // namespace relief
