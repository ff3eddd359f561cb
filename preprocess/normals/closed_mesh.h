// Detects meshes that enclose a body, and those that have no border.
#pragma once

#include "common/mesh/mesh_edges.h"
#include "common/points.h"

namespace relief {

/// Returns whether a cleaned mesh is the surface of one or several bodies, with normals outward.
/// Every point must be a corner, every edge must belong to exactly two triangles, which traverse it
/// in opposite directions, and every component must enclose a positive volume. (A body with a
/// cavity is not closed in this sense: the cavity's volume is negative.) The mesh's normals must
/// not oppose its triangles, because patches follow them. False without triangles. `edges` are the
/// mesh's edges. Only the first `given` points are checked, not those added to triangles later.
[[nodiscard]] bool is_closed_mesh(const Points& mesh, std::size_t given, const MeshEdges& edges);

/// Returns whether no edge of a mesh is at a border. Unlike a closed mesh, one without a border may
/// touch or overlap itself (dragon_vrip_res3 has edges of four to eight triangles), and some of its
/// points may have no triangle. Arguments as above.
[[nodiscard]] bool is_borderless_mesh(const Points& mesh, std::size_t given,
                                      const MeshEdges& edges);

}  // namespace relief
