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
  std::uint32_t best = kNone;
  double best_squared = std::numeric_limits<double>::infinity();
  for (double r = std::min(cell_, radius);; r = std::min(2.0 * r, radius)) {
    for_each_within(x, y, r, [&](std::uint32_t p, double squared) {
      if (squared < best_squared || (squared == best_squared && p < best)) {
        best = p;
        best_squared = squared;
      }
    });
    if (best != kNone || r >= radius) return best;
  }
}

}  // namespace relief
