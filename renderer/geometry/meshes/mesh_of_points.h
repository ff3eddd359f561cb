// A scan with faces as the ray tracer takes it.
#pragma once

#include "common/points.h"
#include "renderer/geometry/meshes/triangle_mesh.h"

namespace relief {

/// The triangles of a scan, smooth: a vertex has the normal that the file gives it, made a unit
/// vector, or where that is missing, 0 or no number the mean of its triangles' normals, weighted by
/// angle. Designed meshes without normals (is_designed_mesh) have creases, which repeat vertices.
/// The triangles should be oriented alike, or these means cancel out. Positions must be numbers and
/// indices valid, as after clean_points. Triangles with materials (load_textures) have their
/// colours and normal maps.
[[nodiscard]] TriangleMesh mesh_of_points(const Points& points);

}  // namespace relief
