// The triangles that corrected interpolation stands for, and that the primitive `cell` draws.
#pragma once

#include "common/error.h"
#include "common/patch.h"
#include "renderer/triangle_mesh.h"

namespace relief {

/// The triangulation of all patches: each grid cell halved along the diagonal from (0, 0) to (1, 1)
/// (paper 001, section 3.5), but for triangles with a hole at a corner. Normals and colours are
/// those of the maps at the nodes; what maps with several texels a cell hold between the nodes is
/// left out. UVs are grid coordinates.
///
/// Patches are not joined: each has its own vertices, and where their margins overlap there are two
/// surfaces, some hundredths of a cell apart, of which a ray meets the nearer. Between the ragged
/// borders of two patches that do not overlap there is nothing, where `onepass` draws splats that
/// reach half a cell beyond the border. Fails if there are more samples than 32 bits count.
Result<TriangleMesh> mesh_of_patches(const PatchModel& model);

}  // namespace relief
