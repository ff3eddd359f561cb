// Closes the small gaps that no triangle could be grown in.
#pragma once

#include "common/seams/stitching/front.h"

namespace relief {

/// Fills loops of up to 14 border edges between patches or where a patch's cells are too steep, and
/// other ones of up to 6 of one patch, with ears: triangles that each cut off a corner, the
/// roundest first, those that fold over last. If the surface `is_closed` (PatchRun::is_closed), all
/// loops of up to 128. The outside of an island stays.
void fill_loops(Front& front, bool is_closed);

}  // namespace relief
