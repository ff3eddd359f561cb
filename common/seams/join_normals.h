// Normals beyond the borders of patches that meet.
#pragma once

#include "common/patch.h"

namespace relief {

/// Sets the normals of holes beside samples, of maps with one texel a cell, in patches that meet
/// others: those of the neighbours' samples about the hole join its own patch's, so that the
/// shading of both is the same at their seam. At a crease each patch keeps its own, unless both
/// turn toward each other: then shading turns within the triangles beside the crease. Files do not
/// hold normals of holes, so conversion and reader both call this.
void join_normals(PatchModel& model);

}  // namespace relief
