// Heights of a patch with a rim of holes, so that nothing asks for the edge.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/patch.h"

namespace relief {

/// Height indices with two rings of holes around, by padded index.
class PaddedHeights {
 public:
  explicit PaddedHeights(const Patch& patch)
      : stride_(std::size_t{patch.width} + 2 * kRings),
        heights_(stride_ * (std::size_t{patch.height} + 2 * kRings), kHole) {
    for (std::uint32_t j = 0; j < patch.height; ++j) {
      std::copy_n(patch.heights.begin() + static_cast<std::ptrdiff_t>(j) * patch.width, patch.width,
                  heights_.begin() + static_cast<std::ptrdiff_t>(index(0, j)));
    }
  }
  [[nodiscard]] std::size_t index(std::uint32_t i, std::uint32_t j) const {
    return (std::size_t{j} + kRings) * stride_ + i + kRings;
  }
  [[nodiscard]] std::size_t stride() const { return stride_; }
  [[nodiscard]] std::size_t size() const { return heights_.size(); }
  [[nodiscard]] std::int32_t operator[](std::size_t k) const { return heights_[k]; }
  [[nodiscard]] bool valid(std::size_t k) const { return heights_[k] != kHole; }

 private:
  static constexpr std::size_t kRings = 2;
  std::size_t stride_;
  std::vector<std::int32_t> heights_;
};

/// Whether a hole or the patch's edge is among a node's eight neighbours.
[[nodiscard]] inline bool is_border(const PaddedHeights& heights, std::size_t k) {
  const std::size_t above = k - heights.stride();
  const std::size_t below = k + heights.stride();
  for (const std::size_t row : {above, k, below}) {
    if (!heights.valid(row - 1) || !heights.valid(row) || !heights.valid(row + 1)) return true;
  }
  return false;
}

}  // namespace relief
