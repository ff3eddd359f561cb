// The surface of patches as other programs take it.
#pragma once

#include "common/error.h"
#include "common/patch.h"
#include "common/points.h"

namespace relief {

/// Returns the samples of all patches with normals, and colours and scalars if the model has some.
[[nodiscard]] Result<Points> sample_points(const PatchModel& model);

/// Returns mesh_of_patches() with the same attributes but scalars. Patches that meet at seams are
/// one mesh: what shares a seam vertex is there once, with the mean normal and colour of all its
/// patches, also at a crease, because a mesh with two vertices there would be open. Then samples
/// without a triangle are left out, too, and in a closed surface the pieces that lie over it and
/// are not connected with it.
[[nodiscard]] Result<Points> surface_mesh(const PatchModel& model);

}  // namespace relief
