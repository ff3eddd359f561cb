// Removes points from a scan, with their attributes and triangles.
#pragma once

#include <cstdint>
#include <vector>

#include "common/points.h"

namespace relief {

/// Keeps the points listed in `kept` (ascending) with their attributes. `new_index` maps old
/// indices to new ones, kNoPoint for removed points. Triangles that lose a corner, have two equal
/// corners or repeat an earlier one, are dropped: of 20,000 equal quads two triangles remain.
void keep_points(Points& points, const std::vector<std::uint32_t>& kept,
                 const std::vector<std::uint32_t>& new_index);

/// Drops the points i with `dropped[i]` not 0, and their triangles. Returns the number of dropped
/// points.
std::uint64_t drop_points(Points& points, const std::vector<std::uint8_t>& dropped);

}  // namespace relief
