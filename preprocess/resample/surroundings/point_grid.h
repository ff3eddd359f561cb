// The neighbour lookup of resampling: points of a patch in square buckets over its base plane.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "preprocess/resample/surroundings/patch_points.h"

namespace relief {

/// Buckets over the base plane. On a single-valued region, near on the plane is near on the
/// surface, so this replaces a search in space.
class PointGrid {
 public:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  /// Uses the first `count` points; `cell` is the side of a bucket, world units.
  PointGrid(const PatchPoints& points, std::size_t count, double cell);

  /// Returns the number of points used.
  [[nodiscard]] std::size_t size() const { return sorted_.size(); }

  /// Calls fn(index, squared plane distance) for every point within `radius` of (x, y).
  template <class Fn>
  void for_each_within(double x, double y, double radius, Fn&& fn) const {
    const std::int64_t i0 = column(x - radius);
    const std::int64_t i1 = column(x + radius);
    const std::int64_t j0 = row(y - radius);
    const std::int64_t j1 = row(y + radius);
    // About half of the points are outside, in no order that a processor could predict: those
    // inside are collected without a branch.
    std::array<std::uint32_t, kAtOnce> inside;
    std::array<double, kAtOnce> distances;
    for (std::int64_t j = j0; j <= j1; ++j) {
      const std::uint32_t* start = starts_.data() + j * columns_;
      const std::uint32_t end = start[i1 + 1];
      for (std::uint32_t m = start[i0]; m < end;) {
        const std::uint32_t stop = std::min(end, m + kAtOnce);
        std::size_t count = 0;
        for (; m < stop; ++m) {
          const double dx = positions_[m].x - x;
          const double dy = positions_[m].y - y;
          const double squared = dx * dx + dy * dy;
          inside[count] = m;
          distances[count] = squared;
          count += squared <= radius * radius ? 1 : 0;
        }
        for (std::size_t k = 0; k < count; ++k) fn(sorted_[inside[k]], distances[k]);
      }
    }
  }

  /// Returns the point nearest to (x, y) on the plane within `radius`, or kNone.
  [[nodiscard]] std::uint32_t nearest(double x, double y, double radius) const;

 private:
  /// Number of points whose distances are computed at a time.
  static constexpr std::uint32_t kAtOnce = 32;

  // Positions outside the grid count to its rim. (Clamped first, so that truncation is the floor.)
  [[nodiscard]] std::int64_t column(double x) const {
    return static_cast<std::int64_t>(
        std::clamp((x - low_x_) / cell_, 0.0, static_cast<double>(columns_ - 1)));
  }
  [[nodiscard]] std::int64_t row(double y) const {
    return static_cast<std::int64_t>(
        std::clamp((y - low_y_) / cell_, 0.0, static_cast<double>(rows_ - 1)));
  }

  double cell_;
  double low_x_ = 0.0;
  double low_y_ = 0.0;
  std::int64_t columns_ = 1;
  std::int64_t rows_ = 1;
  std::vector<std::uint32_t> starts_;  // of each bucket in sorted_, row-major, with an end
  std::vector<std::uint32_t> sorted_;
  std::vector<glm::dvec2> positions_;  // of sorted_, adjacent as they are read
};

}  // namespace relief
