#include "preprocess/resample/surroundings/point_grid.h"

#include <algorithm>
#include <cmath>

namespace relief {

PointGrid::PointGrid(const PatchPoints& points, std::size_t count, double cell) : cell_(cell) {
  low_x_ = low_y_ = std::numeric_limits<double>::infinity();
  double high_x = -low_x_;
  double high_y = -low_y_;
  for (std::size_t p = 0; p < count; ++p) {
    low_x_ = std::min(low_x_, points.positions[p].x);
    low_y_ = std::min(low_y_, points.positions[p].y);
    high_x = std::max(high_x, points.positions[p].x);
    high_y = std::max(high_y, points.positions[p].y);
  }
  // A far outlier must not make the table larger than the points justify.
  const double budget = 16.0 * static_cast<double>(count) + 1024.0;
  while (((high_x - low_x_) / cell_ + 1.0) * ((high_y - low_y_) / cell_ + 1.0) > budget) {
    cell_ *= 2.0;
  }
  columns_ = static_cast<std::int64_t>((high_x - low_x_) / cell_) + 1;
  rows_ = static_cast<std::int64_t>((high_y - low_y_) / cell_) + 1;

  starts_.assign(static_cast<std::size_t>(columns_ * rows_) + 1, 0);
  const auto bucket = [&](std::size_t p) {
    return static_cast<std::size_t>(row(points.positions[p].y) * columns_ +
                                    column(points.positions[p].x));
  };
  for (std::size_t p = 0; p < count; ++p) ++starts_[bucket(p) + 1];
  for (std::size_t b = 1; b < starts_.size(); ++b) starts_[b] += starts_[b - 1];
  std::vector<std::uint32_t> cursor(starts_.begin(), starts_.end() - 1);
  sorted_.resize(count);
  positions_.resize(count);
  for (std::size_t p = 0; p < count; ++p) {
    const std::uint32_t position = cursor[bucket(p)]++;
    sorted_[position] = static_cast<std::uint32_t>(p);
    positions_[position] = glm::dvec2(points.positions[p]);
  }
}

std::uint32_t PointGrid::nearest(double x, double y, double radius) const {
  const std::int64_t i = column(x);
  const std::int64_t j = row(y);
  /// How far a coordinate, from the lowest, is from these buckets of its row or column.
  const auto distance_to = [this](double from_low, std::int64_t first, std::int64_t last) {
    return std::max({static_cast<double>(first) * cell_ - from_low,
                     from_low - static_cast<double>(last + 1) * cell_, 0.0});
  };
  const double beside_x = distance_to(x - low_x_, 0, columns_ - 1);
  const double beside_y = distance_to(y - low_y_, 0, rows_ - 1);
  const double beside = beside_x * beside_x + beside_y * beside_y;
  std::uint32_t best = kNone;
  double best_squared = radius * radius;
  const auto look_at = [&](std::int64_t line, std::int64_t first, std::int64_t last) {
    const double across = distance_to(x - low_x_, first, last);
    const double along = distance_to(y - low_y_, line, line);
    if (across * across + along * along > best_squared) return;
    const std::uint32_t* start = starts_.data() + line * columns_;
    for (std::uint32_t m = start[first]; m < start[last + 1]; ++m) {
      const double dx = positions_[m].x - x;
      const double dy = positions_[m].y - y;
      const double squared = dx * dx + dy * dy;
      if (squared > best_squared) continue;
      if (squared == best_squared && best <= sorted_[m]) continue;
      best = sorted_[m];
      best_squared = squared;
    }
  };
  // Squares of buckets about that of the position, or about the nearest one if it lies beside all.
  // Points of the next square are at least `inner` from the position's nearest in the grid.
  for (std::int64_t k = 0; k <= std::max(columns_, rows_); ++k) {
    const double inner = static_cast<double>(std::max(k - 1, std::int64_t{0})) * cell_;
    if (beside + inner * inner > best_squared) break;
    const std::int64_t left = std::max(i - k, std::int64_t{0});
    const std::int64_t right = std::min(i + k, columns_ - 1);
    for (std::int64_t line = std::max(j - k, std::int64_t{0}); line <= std::min(j + k, rows_ - 1);
         ++line) {
      if (line == j - k || line == j + k) {
        look_at(line, left, right);
        continue;
      }
      if (left == i - k) look_at(line, left, left);
      if (right == i + k && k > 0) look_at(line, right, right);
    }
  }
  return best;
}

}  // namespace relief
