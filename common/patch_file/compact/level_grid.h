// The grids of codec 2 of the patch file: every 2^level-th node of a patch in both directions, with
// a margin, so that access to neighbours needs no test for the rim.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/patch.h"

namespace relief {

/// One level of a patch. Nodes (-kRim, -kRim) to (width + kRim - 1, height + kRim - 1) may be read;
/// those outside the grid are holes.
struct LevelGrid {
  static constexpr std::uint32_t kRim = 3;  ///< reach of predictions (height_predictor.h)
  /// Subtracted from heights, so that they are signed 16-bit numbers, which SIMD multiplies in one
  /// step.
  static constexpr std::int32_t kHeightBase = 32768;
  /// Rows are read in blocks of this many nodes, also beyond the end of the last row.
  static constexpr std::uint32_t kBlock = 16;
  static constexpr std::size_t padded(std::size_t width) {
    return (width + kBlock - 1) / kBlock * kBlock;
  }

  LevelGrid(std::uint32_t patch_width, std::uint32_t patch_height, unsigned patch_level)
      : level(patch_level),
        width(((patch_width - 1) >> patch_level) + 1),
        height(((patch_height - 1) >> patch_level) + 1),
        stride(width + 2 * kRim),
        samples(stride * (height + 2 * kRim) + kBlock),
        heights(samples.size()),
        magnitudes(samples.size()) {}

  unsigned level;  ///< neighbouring nodes are 2^level nodes of the patch apart
  std::uint32_t width;
  std::uint32_t height;
  std::size_t stride;                    ///< distance of vertical neighbours
  std::vector<std::uint8_t> samples;     ///< 1 at samples, else 0
  std::vector<std::int16_t> heights;     ///< of already coded samples
  std::vector<std::uint8_t> magnitudes;  ///< of the residuals coded on this level, at most 255

  std::int32_t last = -kHeightBase;  ///< the last coded height

  [[nodiscard]] std::size_t node(std::uint32_t i, std::uint32_t j) const {
    return (j + kRim) * stride + i + kRim;
  }
};

/// Returns the coarsest level of a grid, which has at most two nodes in each direction.
[[nodiscard]] inline unsigned coarsest_level(std::uint32_t width, std::uint32_t height) {
  unsigned level = 0;
  while (((width - 1) >> level) > 1 || ((height - 1) >> level) > 1) ++level;
  return level;
}

/// Sets a level's samples; `mask` is the patch's, row-major.
inline void mark_samples(std::span<const std::uint8_t> mask, std::size_t width, unsigned level,
                         LevelGrid& grid) {
  for (std::uint32_t j = 0; j < grid.height; ++j) {
    const std::uint8_t* row = &mask[(std::size_t{j} << level) * width];
    std::uint8_t* __restrict marks = &grid.samples[grid.node(0, j)];
    if (level == 0) {
      std::copy_n(row, grid.width, marks);
    } else {
      for (std::size_t i = 0; i < grid.width; ++i) marks[i] = row[i << level];
    }
  }
}

/// Copies the heights of the next coarser level to its nodes on `fine`.
inline void take_heights(const LevelGrid& coarse, LevelGrid& fine) {
  fine.last = coarse.last;
  for (std::uint32_t j = 0; j < coarse.height; ++j) {
    const std::int16_t* from = &coarse.heights[coarse.node(0, j)];
    std::int16_t* to = &fine.heights[fine.node(0, 2 * j)];
    for (std::uint32_t i = 0; i < coarse.width; ++i) to[std::size_t{2} * i] = from[i];
  }
}

}  // namespace relief
