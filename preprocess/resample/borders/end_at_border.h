// Ends patches that overlap where the scan ends.
#pragma once

#include <vector>

#include "preprocess/resample/borders/scan_border.h"
#include "preprocess/resample/support/support.h"

namespace relief {

/// Turns nodes beyond the scan's border into holes, and holes before it, beside samples, into
/// samples: what support alone (find_support) leaves is ragged.
void end_at_border(const ScanBorder& border, const PatchPoints& points, const PatchLookups& lookups,
                   const PatchGrid& grid, std::vector<NodeState>& states);

}  // namespace relief
