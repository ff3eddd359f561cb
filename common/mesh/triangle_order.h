// An order of triangles that does not depend on how a file lists them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "common/points.h"

namespace relief {

/// Returns a triangle that begins with its smallest corner. Two that differ only in where they
/// begin are equal then.
[[nodiscard]] inline Triangle smallest_first(Triangle t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

/// Indices of triangles by their smallest corner, then by the next ones, whatever their winding.
/// Of triangles with the same corners, those of one winding come first; equal ones are in their own
/// order.
struct TriangleOrder {
  std::vector<std::uint32_t> triangles;
  std::vector<std::uint32_t> ends;  ///< where each corner's triangles end

  /// Those whose smallest corner is this one.
  [[nodiscard]] std::span<std::uint32_t> at(std::size_t corner) {
    const std::uint32_t begin = corner > 0 ? ends[corner - 1] : 0;
    return std::span(triangles).subspan(begin, ends[corner] - begin);
  }
};

/// Sorts triangles whose corners are below `points`. Leaves those out whose entry in `left_out` is
/// not 0; it may be empty.
[[nodiscard]] TriangleOrder order_triangles(std::span<const Triangle> triangles, std::size_t points,
                                            std::span<const std::uint8_t> left_out = {});

}  // namespace relief
