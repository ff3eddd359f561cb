#include "preprocess/points/on_mesh/densify.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

#include "common/mesh/coarse_mesh.h"
#include "preprocess/points/on_mesh/triangle_points.h"

namespace relief {
namespace {

// Edges longer than this many mean spacings get points.
constexpr double kLongEdge = 2.5;
// Largest number of added points per given or wanted point: a closed mesh of equal small triangles
// beside large ones needs up to 2; needles, with long edges and a small area, could need any
// number.
constexpr std::size_t kMaxAddedPerPoint = 4;

/// The triangles that have an edge longer than `limit`, in their order.
std::vector<std::uint32_t> with_long_edges(const Points& points, double limit) {
  std::vector<std::uint8_t> is_long(points.triangles.size());
  tbb::parallel_for(std::size_t{0}, is_long.size(), [&](std::size_t k) {
    const Triangle& t = points.triangles[k];
    for (std::size_t c = 0; c < 3; ++c) {
      const double length = glm::distance(points.positions[t[c]], points.positions[t[(c + 1) % 3]]);
      if (length > limit) is_long[k] = 1;
    }
  });
  std::vector<std::uint32_t> triangles;
  for (std::uint32_t k = 0; k < is_long.size(); ++k) {
    if (is_long[k] != 0) triangles.push_back(k);
  }
  return triangles;
}

/// Calls `add(triangle, weights)` for the points on large ones of `triangles`, about `step` apart.
/// Ends when that returns false, and returns whether it never did.
template <class Add>
bool for_each_added(const Points& points, const std::vector<std::uint32_t>& triangles, double step,
                    const Add& add) {
  TrianglePoints places(points, kLongEdge * step, step);
  return std::ranges::all_of(
      triangles, [&](std::uint32_t k) { return places.on_edges(k, add) && places.within(k, add); });
}

}  // namespace

std::size_t densify_triangles(Points& points, std::size_t at_least) {
  const std::size_t given = points.size();
  if (points.triangles.empty() || given == 0) return 0;
  const std::size_t wanted = std::max(given, at_least);
  const double spacing = std::sqrt(area_of_triangles(points) / static_cast<double>(wanted));
  // Without an area, or with one beyond doubles, there is no spacing for filling triangles.
  if (!(spacing > 0.0) || !std::isfinite(spacing)) return 0;
  const std::vector<std::uint32_t> large = with_long_edges(points, kLongEdge * spacing);
  // Counted only as far as allowed: needles could ask for thousands of points each.
  const auto fits = [&](double step) {
    const TrianglePoints places(points, kLongEdge * step, step);
    const double at_most =
        std::accumulate(large.begin(), large.end(), 0.0,
                        [&](double sum, std::uint32_t k) { return sum + places.most_on(k); });
    if (at_most <= static_cast<double>(kMaxAddedPerPoint * wanted)) return true;
    std::size_t count = 0;
    return for_each_added(points, large, step, [&](const Triangle&, glm::dvec3) {
      return ++count <= kMaxAddedPerPoint * wanted;
    });
  };
  // Too many: coarser everywhere, instead of leaving some triangles empty.
  double step = spacing;
  while (!fits(step)) step *= 1.5;
  for_each_added(points, large, step, [&](const Triangle& t, glm::dvec3 weights) {
    append_point(points, t, weights, points);
    return true;
  });
  return points.size() - given;
}

}  // namespace relief
