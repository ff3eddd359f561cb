#include "preprocess/patch_distance.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>

namespace relief {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

// Height and slope of the surface over a cell, in grid units.
struct CellSurface {
  double height;
  double slope_x;
  double slope_y;
};

// fx, fy: position within the cell; h: heights of its corners (0,0) (1,0) (0,1) (1,1), NaN for
// holes.
std::optional<CellSurface> over_cell(const double (&h)[4], double fx, double fy) {
  int holes = 0;
  int hole = -1;
  for (int c = 0; c < 4; ++c) {
    if (!std::isnan(h[c])) continue;
    ++holes;
    hole = c;
  }
  if (holes == 0) {
    const double low = h[0] + fx * (h[1] - h[0]);
    const double high = h[2] + fx * (h[3] - h[2]);
    return CellSurface{low + fy * (high - low), (1 - fy) * (h[1] - h[0]) + fy * (h[3] - h[2]),
                       high - low};
  }
  if (holes != 1) return std::nullopt;
  // The missing corner continues the plane of the other three.
  double full[4] = {h[0], h[1], h[2], h[3]};
  full[hole] = full[hole ^ 1] + full[hole ^ 2] - full[hole ^ 3];
  return over_cell(full, fx, fy);
}

double height_at(const Patch& patch, std::int64_t i, std::int64_t j) {
  if (i < 0 || j < 0 || i >= patch.width || j >= patch.height) return std::nan("");
  const std::int32_t h = patch.at(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j));
  return h == kHole ? std::nan("") : h * patch.height_step / patch.spacing;
}

double nearest_sample(const Patch& patch, double x, double y, double z) {
  double best = kFar;
  const auto ci = static_cast<std::int64_t>(std::lround(x));
  const auto cj = static_cast<std::int64_t>(std::lround(y));
  for (std::int64_t j = cj - 2; j <= cj + 2; ++j) {
    for (std::int64_t i = ci - 2; i <= ci + 2; ++i) {
      const double h = height_at(patch, i, j);
      if (std::isnan(h)) continue;
      const glm::dvec3 d(x - static_cast<double>(i), y - static_cast<double>(j), z - h);
      best = std::min(best, glm::dot(d, d));
    }
  }
  return std::sqrt(best);
}

}  // namespace

std::optional<double> distance_to_patch(const Patch& patch, glm::dvec3 point) {
  const glm::dvec3 local = glm::transpose(patch.axes) * (point - patch.origin) / patch.spacing;
  // Two cells around the grid are the search radius.
  if (local.x < -3.0 || local.y < -3.0 || local.x > patch.width + 2.0 ||
      local.y > patch.height + 2.0) {
    return std::nullopt;
  }
  const auto i = static_cast<std::int64_t>(std::floor(local.x));
  const auto j = static_cast<std::int64_t>(std::floor(local.y));
  const double corners[4] = {height_at(patch, i, j), height_at(patch, i + 1, j),
                             height_at(patch, i, j + 1), height_at(patch, i + 1, j + 1)};
  if (const auto cell =
          over_cell(corners, local.x - static_cast<double>(i), local.y - static_cast<double>(j))) {
    const double steep =
        std::sqrt(1.0 + cell->slope_x * cell->slope_x + cell->slope_y * cell->slope_y);
    return std::abs(local.z - cell->height) / steep * patch.spacing;
  }
  const double to_sample = nearest_sample(patch, local.x, local.y, local.z);
  if (to_sample == kFar) return std::nullopt;
  return to_sample * patch.spacing;
}

}  // namespace relief
