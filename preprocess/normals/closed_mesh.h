// Whether a mesh encloses a body.
#pragma once

#include "common/points.h"
#include "preprocess/normals/mesh_edges.h"

namespace relief {

/// Whether a cleaned mesh is known to be the surface of one or several bodies, with normals
/// outward: every point is a corner, every edge is one of exactly two triangles, which run through
/// it in opposite directions, and every piece encloses a positive volume. (A body with a hollow in
/// it is not: the hollow's volume is negative.) Normals that the mesh has must not point against
/// its triangles: patches follow them. False without triangles. `edges` are the mesh's; its
/// first `given` points are looked at, what was added to triangles later is not.
[[nodiscard]] bool is_closed_mesh(const Points& mesh, std::size_t given, const MeshEdges& edges);

}  // namespace relief
