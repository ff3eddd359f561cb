// Which grid nodes of a patch get a sample: where the scan has points, and nowhere else.
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

/// A grid that holds a region's own points with `overlap_cells` + 1 cells around them; its side is
/// limited to kMaxPatchSide by a coarser spacing if need be.
[[nodiscard]] PatchGrid lay_grid(const PatchPoints& points, double spacing, int overlap_cells);

/// Lookups over the points of one patch: its own, those that support samples, and all.
struct PatchLookups {
  const PointGrid& own;
  const PointGrid& supporting;
  const PointGrid& all;
};

/// The state of every node: Own where the region's own points support it, and in slits of one node;
/// Margin within `overlap_cells` of those, where supporting points do, and in slits of one node
/// that then are left, where any point does; Hole elsewhere.
[[nodiscard]] std::vector<NodeState> find_support(const PatchPoints& points,
                                                  const PatchLookups& lookups,
                                                  const PatchGrid& grid, int overlap_cells);

}  // namespace relief
