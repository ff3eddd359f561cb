// Closes the small gaps that no triangle could be grown in.
#pragma once

#include "common/seams/front.h"

namespace relief {

/// Fills loops of up to 14 border edges between patches, and of up to 4 of one patch, with ears:
/// triangles that each cut off a corner, the roundest first.
void fill_loops(Front& front);

}  // namespace relief
