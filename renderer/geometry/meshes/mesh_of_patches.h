// The triangles that corrected interpolation stands for, and that the primitive `cell` draws.
#pragma once

#include <cstdint>
#include <vector>

#include "common/error.h"
#include "common/patch.h"
#include "renderer/geometry/meshes/triangle_mesh.h"

namespace relief {

/// A vertex at a seam: one of those that stand for the same seam vertex, one for each patch there.
struct SeamCopy {
  std::uint32_t vertex = 0;  ///< of the mesh
  std::uint32_t seam = 0;    ///< counted through the whole model
};

/// Whether a mesh has what patches that overlap cover of cells that holes cut (PatchBorder), or
/// ends at their samples.
enum class MeshBorder : std::uint8_t { Curve, Samples };

/// The triangulation of all patches: each grid cell halved along the diagonal from (0, 0) to (1, 1)
/// ([Ochotta 2008], section 3.5), but for triangles with a hole at a corner and those along whose
/// cell's edge it rises by more than kSteepest cells, where a patch jumps from one sheet of the
/// scan to another: no splat leans as much. Normals are those of the maps at the nodes, colours
/// those of the whole map, and both also where it has several texels a cell. UVs are grid
/// coordinates.
///
/// Patches that meet (PatchModel::joined) are joined by their seams (make_seams); only cells of up
/// to kSteepestJoined are theirs. A seam vertex is there once for each patch that shares it, with
/// that patch's normal and colour; these are added to `copies` if it is given.
///
/// Other patches are not joined: each has its own vertices, and where their margins overlap there
/// are two surfaces, some hundredths of a cell apart, of which a ray meets the nearer. Fails if
/// there are more samples than 32 bits count.
Result<TriangleMesh> mesh_of_patches(const PatchModel& model, MeshBorder border = MeshBorder::Curve,
                                     std::vector<SeamCopy>* copies = nullptr);

/// TriangleMesh::bodies of a model with instances; `mesh`: of the model once these are baked.
[[nodiscard]] std::vector<MeshBody> bodies_of(const PatchModel& model, const TriangleMesh& mesh);

}  // namespace relief
