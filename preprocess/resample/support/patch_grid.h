// The grid of a patch, and the lookups of its points.
#pragma once

#include <cstddef>
#include <cstdint>

#include "preprocess/resample/surroundings/point_grid.h"

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

/// Lookups of a patch's points: own points, supporting points, and all.
struct PatchLookups {
  const PointGrid& own;
  const PointGrid& supporting;
  const PointGrid& all;
};

}  // namespace relief
