// Predicts integers on a grid with holes from neighbours that a decoder already has.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/patch_file/fast/residuals.h"

namespace relief {

/// A row-major grid of integers; some are kept (1), the others are holes (0).
struct KeptGrid {
  std::size_t width = 0;
  std::size_t height = 0;
  std::span<const std::uint8_t> kept;
};

/// The neighbours of a node that come before it in scan order. A value without its flag is 0.
struct Neighbours {
  bool west = false;
  bool north = false;
  bool north_west = false;
  bool north_east = false;
  std::int32_t w = 0;
  std::int32_t n = 0;
  std::int32_t nw = 0;
  std::int32_t ne = 0;
};

/// Predicts by the plane through three neighbours, or the nearest neighbour, or `last` (the last
/// kept value).
[[nodiscard]] inline std::int32_t predict_plane(const Neighbours& at, std::int32_t last) {
  if (at.west && at.north && at.north_west) return at.w + at.n - at.nw;
  if (at.west) return at.w;
  if (at.north) return at.n;
  if (at.north_west) return at.nw;
  return at.north_east ? at.ne : last;
}

/// Predicts by the mean of the western and the northern neighbour, rounded toward zero; for values
/// that vary little about zero and have no slope to continue.
[[nodiscard]] inline std::int32_t predict_mean(const Neighbours& at, std::int32_t /*last*/) {
  if (at.west && at.north) return (at.w + at.n) / 2;
  return at.w + at.n;
}

/// Predicts by the median of the western value, the northern value and the plane through both and
/// the one between (as in JPEG-LS, ITU-T T.87, which does not continue an edge beyond either side);
/// by predict_plane if one of them is missing.
[[nodiscard]] inline std::int32_t predict_median(const Neighbours& at, std::int32_t last) {
  const std::int32_t plane = predict_plane(at, last);
  if (!(at.west && at.north && at.north_west)) return plane;
  return std::clamp(plane, std::min(at.w, at.n), std::max(at.w, at.n));
}

/// Returns the neighbours of node k, which is in column i. Reads `values` only at kept nodes before
/// k.
[[nodiscard]] inline Neighbours neighbours_at(const KeptGrid& grid,
                                              std::span<const std::int32_t> values, std::size_t i,
                                              std::size_t k) {
  const std::size_t width = grid.width;
  Neighbours at;
  at.west = i > 0 && grid.kept[k - 1] != 0;
  if (at.west) at.w = values[k - 1];
  if (k >= width) {
    at.north = grid.kept[k - width] != 0;
    at.north_west = i > 0 && grid.kept[k - width - 1] != 0;
    at.north_east = i + 1 < width && grid.kept[k - width + 1] != 0;
    if (at.north) at.n = values[k - width];
    if (at.north_west) at.nw = values[k - width - 1];
    if (at.north_east) at.ne = values[k - width + 1];
  }
  return at;
}

/// Calls `visit(k, prediction)` for each kept node k in scan order; it returns the value there.
/// Reads `values` only at visited nodes.
template <class Predict, class Visit>
void visit_predicted(const KeptGrid& grid, std::span<const std::int32_t> values,
                     const Predict& predict, const Visit& visit) {
  std::int32_t last = 0;
  std::size_t k = 0;
  for (std::size_t j = 0; j < grid.height; ++j) {
    for (std::size_t i = 0; i < grid.width; ++i, ++k) {
      if (grid.kept[k] != 0) last = visit(k, predict(neighbours_at(grid, values, i, k), last));
    }
  }
}

/// Appends the residual of each kept value, modulo 2^16.
template <class Predict>
void append_predicted(const KeptGrid& grid, std::span<const std::int32_t> values,
                      const Predict& predict, std::vector<std::uint16_t>& residuals) {
  visit_predicted(grid, values, predict, [&](std::size_t k, std::int32_t prediction) {
    residuals.push_back(zigzag(static_cast<std::uint16_t>(values[k] - prediction)));
    return values[k];
  });
}

/// Inverse of append_predicted: sets each kept value to `from_bits` of its 16 bits. `residuals` has
/// one value for each kept node.
template <class Predict, class FromBits>
void undo_predicted(const KeptGrid& grid, std::span<const std::uint16_t> residuals,
                    const Predict& predict, const FromBits& from_bits,
                    std::span<std::int32_t> values) {
  auto residual = residuals.begin();
  visit_predicted(grid, values, predict, [&](std::size_t k, std::int32_t prediction) {
    values[k] = from_bits(static_cast<std::uint16_t>(prediction + unzigzag(*residual++)));
    return values[k];
  });
}

}  // namespace relief
