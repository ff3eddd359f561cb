// The points that a coloured mesh is converted from.
#pragma once

#include "common/error.h"
#include "common/points.h"

namespace relief {

/// Points on the triangles of a mesh that has colours of its own, evenly apart, with the vertices'
/// normals interpolated as `raytrace` does: the file's, or where they are missing the means of the
/// triangles'. For textured meshes are coarse: their shape is in the triangles between the
/// vertices, which are far apart beside the texels. No faces and no attributes but normals.
///
/// There are 100,000, or as many as vertices where these are more; and where `spacing` (world
/// units) is above 0, one for each square of it at least, up to 2 million. Fails, with a clause, if
/// the triangles have no area. Does not depend on the number of threads.
Result<Points> sample_mesh(const Points& mesh, double spacing);

}  // namespace relief
