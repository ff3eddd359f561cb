// Removes points from a scan, with their attributes and triangles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/points.h"

namespace relief {

/// Keeps the points listed in `kept` (ascending) with their attributes. `new_index` maps old
/// indices to new ones, kNoPoint for removed points. Triangles that lose a corner, have two equal
/// corners or repeat an earlier one, are dropped: of 20,000 equal quads two triangles remain.
void keep_points(Points& points, const std::vector<std::uint32_t>& kept,
                 const std::vector<std::uint32_t>& new_index);

/// Adds the normal of a point to that of another, which it is merged into; nothing without normals.
/// The sum has the mean's direction; its length does not matter. NaN and infinity do not count.
void add_normal(Points& points, std::uint32_t to, std::uint32_t from);

/// Returns the new index of each point once some are dropped; kNoPoint for those.
[[nodiscard]] std::vector<std::uint32_t> indices_after(const std::vector<std::uint8_t>& dropped);

/// Drops the values i with `dropped[i]` not 0.
template <class T>
void drop_values(std::span<const std::uint8_t> dropped, std::vector<T>& values) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (dropped[i] == 0) values[kept++] = values[i];
  }
  values.resize(kept);
}

/// Drops the points i with `dropped[i]` not 0, and their triangles. Returns the number of dropped
/// points.
std::uint64_t drop_points(Points& points, const std::vector<std::uint8_t>& dropped);

}  // namespace relief
