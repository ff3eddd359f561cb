// Detects meshes that enclose a body.
#pragma once

#include "common/points.h"
#include "preprocess/normals/mesh_edges.h"

namespace relief {

/// Returns whether a cleaned mesh is the surface of one or several bodies, with normals outward.
/// Every point must be a corner, every edge must belong to exactly two triangles, which traverse it
/// in opposite directions, and every component must enclose a positive volume. (A body with a
/// cavity is not closed in this sense: the cavity's volume is negative.) The mesh's normals must
/// not oppose its triangles, because patches follow them. False without triangles. `edges` are the
/// mesh's edges. Only the first `given` points are checked, not those added to triangles later.
[[nodiscard]] bool is_closed_mesh(const Points& mesh, std::size_t given, const MeshEdges& edges);

}  // namespace relief
