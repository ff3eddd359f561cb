// Which border vertices the cells of their patch connect.
#pragma once

#include <span>

#include "common/patch.h"
#include "common/seams/border_mesh.h"
#include "common/seams/cell_triangles.h"

namespace relief {

/// Finds for each vertex the first one that triangles of cells connect it to, itself if there is
/// none before it (BorderMesh::parts). Unlike border edges these know of what lies between two
/// borders of one patch.
void find_parts(std::span<const Patch> patches, std::span<const CellTriangles> cells,
                BorderMesh& mesh);

}  // namespace relief
