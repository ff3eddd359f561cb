// Triangles between the borders of patches.
#pragma once

#include <vector>

#include "common/points.h"
#include "common/seams/border_mesh.h"

namespace relief {

/// Closes the gaps between patches that end where others begin: grows triangles from border edges,
/// the smallest circumscribed circle first, as zippering [Turk and Levoy 1994] and ball pivoting
/// [Bernardini 1999] do. Each triangle takes a border edge and a border vertex and leaves an
/// orientable surface; none folds over, crosses a border or covers a vertex. Gaps wider than
/// about three spacings stay open, as do holes of a single patch, unless the surface `is_closed`
/// (PatchRun::is_closed). Corners are border vertices,
/// counterclockwise seen from outside. The order of `mesh` decides between equals, nothing else
/// does.
[[nodiscard]] std::vector<Triangle> stitch(const BorderMesh& mesh, bool is_closed = false);

}  // namespace relief
