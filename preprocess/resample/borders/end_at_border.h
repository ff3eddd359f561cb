// Ends patches that overlap where the scan ends.
#pragma once

#include <vector>

#include "preprocess/resample/borders/scan_border.h"
#include "preprocess/resample/support.h"

namespace relief {

/// Nodes beyond the border of the scan become holes, and holes before it and beside samples become
/// samples like them: support alone (find_support) leaves a ragged border.
void end_at_border(const ScanBorder& border, const PatchPoints& points, const PatchLookups& lookups,
                   const PatchGrid& grid, std::vector<NodeState>& states);

}  // namespace relief
