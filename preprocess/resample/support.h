// Decides which grid nodes of a patch get a sample: only those where the scan has points.
#pragma once

#include <vector>

#include "preprocess/resample/point_grid.h"

namespace relief {

/// The nodes of a patch grid; node (i, j) is at local (x0 + i spacing, y0 + j spacing).
struct PatchGrid {
  double x0 = 0.0;
  double y0 = 0.0;
  double spacing = 1.0;
  std::uint32_t width = 0;
  std::uint32_t height = 0;

  [[nodiscard]] std::size_t size() const { return std::size_t{width} * height; }
};

enum class NodeState : std::uint8_t { Hole, Own, Margin };

/// Returns a grid that holds a region's own points, with `overlap_cells` + 1 cells around them. A
/// coarser spacing limits its sides to kMaxPatchSide if necessary.
[[nodiscard]] PatchGrid lay_grid(const PatchPoints& points, double spacing, int overlap_cells);

/// Lookups of a patch's points: own points, supporting points, and all.
struct PatchLookups {
  const PointGrid& own;
  const PointGrid& supporting;
  const PointGrid& all;
};

/// Returns the state of every node. Own: the region's own points support the node, or it is a slit
/// of one node. Margin: within `overlap_cells` of own nodes, supported by supporting points, or a
/// remaining slit of one node that any point supports. Hole: all others.
[[nodiscard]] std::vector<NodeState> find_support(const PatchPoints& points,
                                                  const PatchLookups& lookups,
                                                  const PatchGrid& grid, int overlap_cells);

}  // namespace relief
