// Makes the surface between patches that meet.
#pragma once

#include <span>

#include "common/patch.h"
#include "common/seams/seams.h"

namespace relief {

/// Makes the seams of patches that meet (PatchModel::joined): stitches their borders, and puts a
/// vertex on each edge between two patches, where the surface through both ends and their normals
/// is half-way, or where their tangent planes meet if there is a crease. `is_closed`: as
/// PatchRun::is_closed.
[[nodiscard]] Seams make_seams(std::span<const Patch> patches, bool is_closed = false);

}  // namespace relief
