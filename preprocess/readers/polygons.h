// Splits the faces of files into triangles.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/points.h"

namespace relief {

/// Appends a polygon as a fan about its first corner; nothing if it has fewer than three corners.
inline void append_polygon(std::span<const std::uint32_t> corners,
                           std::vector<Triangle>& triangles) {
  for (std::size_t i = 2; i < corners.size(); ++i) {
    triangles.push_back({corners[0], corners[i - 1], corners[i]});
  }
}

/// Appends triangle strips as in PLY's `tristrips`: each index forms a triangle with the two before
/// it, with every second one flipped. kNoPoint (written -1) starts a new strip.
inline void append_strips(std::span<const std::uint32_t> indices,
                          std::vector<Triangle>& triangles) {
  std::size_t start = 0;
  for (std::size_t i = 0; i < indices.size(); ++i) {
    if (indices[i] == UINT32_MAX) start = i + 1;
    if (i < start + 2 || start > i) continue;
    const bool odd = (i - start) % 2 == 1;
    triangles.push_back(odd ? Triangle{indices[i - 1], indices[i - 2], indices[i]}
                            : Triangle{indices[i - 2], indices[i - 1], indices[i]});
  }
}

}  // namespace relief
