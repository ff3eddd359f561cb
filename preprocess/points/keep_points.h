// Leaving out some of a scan's points, with what hangs on them.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "common/points.h"

namespace relief {

/// Whether none of a vector's components is NaN or infinite.
template <class Vector>
[[nodiscard]] bool is_finite(const Vector& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Keeps the points that `kept` lists (ascending) with their attributes. Triangles take the corners
/// that `new_index` gives for the old ones, kNoPoint for none; those that lose a corner, or have
/// two in one point, are dropped.
void keep_points(Points& points, const std::vector<std::uint32_t>& kept,
                 const std::vector<std::uint32_t>& new_index);

/// Drops the points i with `dropped[i]` not 0, and the triangles at them. Returns how many.
std::uint64_t drop_points(Points& points, const std::vector<std::uint8_t>& dropped);

}  // namespace relief
