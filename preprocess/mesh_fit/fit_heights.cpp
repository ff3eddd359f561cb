#include "preprocess/mesh_fit/fit_heights.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "preprocess/resample/heights/store_heights.h"
#include "preprocess/texture/maps/map_scales.h"
#include "preprocess/texture/maps/shown_triangles.h"

namespace relief {
namespace {

// Triangles this many cells above or below the surface are another sheet's.
constexpr double kReach = 1.0;
// Weight of a sample's height before the fit, which bulges outward as the mesh's points do; that of
// one height of the triangles is 1. Border pixels of four views, with 0 and 0.3: dragon_vrip_res3
// 4,084 and 3,771, lucy_50k 2,128 and 2,075.
constexpr double kOwnWeight = 0.3;
// A step of this many cells ends the fit: a tenth of a default height step.
constexpr double kStep = 0.005;
constexpr int kMostIterations = 16;

/// A height of the triangles, cells: at a node if both are the same, otherwise half-way between
/// two, where a cell has an edge or its diagonal.
struct Target {
  std::uint32_t a = 0;
  std::uint32_t b = 0;
  double height = 0.0;
};

std::vector<Target> find_targets(const std::vector<FlatTriangle>& triangles,
                                 std::span<const std::uint32_t> shown, const Patch& patch,
                                 const std::vector<double>& heights) {
  std::vector<Target> targets;
  targets.reserve(shown.size());
  const std::uint64_t columns = map_side(patch.width, kFitTexelsPerCell);
  for (std::uint32_t k = 0; k < shown.size(); ++k) {
    if (shown[k] == kNoTriangle) continue;
    const FlatTriangle& triangle = triangles[shown[k]];
    if (triangle.twice_area <= 0.0) continue;
    const auto column = static_cast<std::uint32_t>(k % columns);
    const auto row = static_cast<std::uint32_t>(k / columns);
    Target target;
    target.a = row / 2 * patch.width + column / 2;
    target.b = (row + 1) / 2 * patch.width + (column + 1) / 2;
    if (patch.heights[target.a] == kHole || patch.heights[target.b] == kHole) continue;
    target.height = triangle.height_at(0.5 * glm::dvec2(column, row));
    const double now = 0.5 * (heights[target.a] + heights[target.b]);
    if (std::abs(target.height - now) <= kReach) targets.push_back(target);
  }
  return targets;
}

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
  return sum;
}

/// Solves the normal equations by conjugate gradients, a few steps of which do. solve_spd() would
/// need their matrix, of which the targets are the factors.
void solve(const std::vector<Target>& targets, std::vector<double>& heights) {
  const std::size_t count = heights.size();
  std::vector<double> residual(count, 0.0);
  for (const Target& t : targets) {
    const double off = 0.5 * (t.height - 0.5 * (heights[t.a] + heights[t.b]));
    residual[t.a] += off;
    residual[t.b] += off;
  }
  std::vector<double> direction = residual;
  std::vector<double> image(count);
  double squared = dot(residual, residual);
  for (int k = 0; k < kMostIterations && squared > 0.0; ++k) {
    for (std::size_t n = 0; n < count; ++n) image[n] = kOwnWeight * direction[n];
    for (const Target& t : targets) {
      const double mean = 0.25 * (direction[t.a] + direction[t.b]);
      image[t.a] += mean;
      image[t.b] += mean;
    }
    const double step = squared / dot(direction, image);
    double largest = 0.0;
    for (std::size_t n = 0; n < count; ++n) {
      heights[n] += step * direction[n];
      residual[n] -= step * image[n];
      largest = std::max(largest, std::abs(step * direction[n]));
    }
    if (largest < kStep) return;
    const double next = dot(residual, residual);
    for (std::size_t n = 0; n < count; ++n)
      direction[n] = residual[n] + next / squared * direction[n];
    squared = next;
  }
}

}  // namespace

void fit_heights(std::vector<FlatTriangle>& triangles, std::span<const std::uint32_t> shown,
                 Patch& patch) {
  std::vector<double> heights;
  heights.reserve(patch.heights.size());
  for (const std::int32_t h : patch.heights)
    heights.push_back(h == kHole ? 0.0 : h * patch.height_step / patch.spacing);
  const std::vector<Target> targets = find_targets(triangles, shown, patch, heights);
  if (targets.empty()) return;
  solve(targets, heights);
  for (double& height : heights) height *= patch.spacing;
  const double lowest = store_heights(heights, patch.height_step, patch);
  patch.origin += patch.axes * glm::dvec3(0.0, 0.0, lowest);
  for (FlatTriangle& triangle : triangles) triangle.heights -= lowest / patch.spacing;
}

}  // namespace relief
