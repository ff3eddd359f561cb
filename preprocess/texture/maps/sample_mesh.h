// Samples coloured meshes for conversion.
#pragma once

#include "common/error.h"
#include "common/points.h"

namespace relief {

/// Returns evenly spaced points on the triangles of a coloured mesh, with normals interpolated
/// between vertices as `raytrace` does: the file's normals, or means of the triangles' if they are
/// missing. Textured meshes need this because their vertices are far apart compared with texels.
/// The result has no faces and no attributes but normals.
///
/// The number of points is 100,000, or that of the vertices if they are more. If `spacing` (world
/// units) is above 0, it is at least one for each square of that side, up to 2 million. Fails, with
/// a clause, if the triangles have no area. The result does not depend on the number of threads.
Result<Points> sample_mesh(const Points& mesh, double spacing);

}  // namespace relief
