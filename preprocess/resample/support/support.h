// Decides which grid nodes of a patch get a sample: only those where the scan has points.
#pragma once

#include <vector>

#include "preprocess/resample/support/patch_grid.h"

namespace relief {

enum class NodeState : std::uint8_t { Hole, Own, Margin };

/// Rings of nodes, beyond the margin, that a coarse grid may bridge the gap to a denser part with:
/// points at random have gaps of up to 2.2 spacings.
inline constexpr int kBridgeRings = 2;
/// The margin of a grid at a step of density: where a margin of one node ends with the denser
/// points, it may only touch theirs.
inline constexpr int kStepRings = 2;

/// Returns a grid that holds a region's own points, with `overlap_cells` + 1 cells around them. A
/// coarser spacing limits its sides to kMaxPatchSide if necessary.
[[nodiscard]] PatchGrid lay_grid(const PatchPoints& points, double spacing, int overlap_cells);

/// Returns the state of every node. Own: the region's own points support the node, or it is a slit
/// of one node. Margin: within `overlap_cells` of own nodes, supported by supporting points, or a
/// remaining slit of one node that any point supports. With `least_of_others` of the points it has
/// kStepRings, about as many as kBridgeRings more where a gap is. Hole: all others.
[[nodiscard]] std::vector<NodeState> find_support(const PatchPoints& points,
                                                  const PatchLookups& lookups,
                                                  const PatchGrid& grid, int overlap_cells);

}  // namespace relief
