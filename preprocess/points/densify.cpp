#include "preprocess/points/densify.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <unordered_set>

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

// Pieces of about `step` that a length is cut into; hostile lengths are cut into no more than 4096.
int count_pieces(double length, double step) {
  return static_cast<int>(std::min(length / step, 4095.0)) + 1;
}

// Appends the point with barycentric weights `w` in triangle `t`.
void append(Points& points, const Triangle& t, glm::dvec3 w) {
  const auto mix = [&](const auto& values, auto zero) {
    for (glm::length_t c = 0; c < 3; ++c) {
      zero += static_cast<typename decltype(zero)::value_type>(w[c]) *
              decltype(zero)(values[t[static_cast<std::size_t>(c)]]);
    }
    return zero;
  };
  points.positions.push_back(mix(points.positions, glm::dvec3(0.0)));
  if (!points.normals.empty()) points.normals.push_back(mix(points.normals, glm::vec3(0.0F)));
  if (!points.colours.empty()) {
    points.colours.emplace_back(mix(points.colours, glm::vec3(0.0F)) + 0.5F);
  }
  if (!points.texcoords.empty()) points.texcoords.push_back(mix(points.texcoords, glm::vec2(0.0F)));
  const glm::length_t nearest = w.x >= w.y ? (w.x >= w.z ? 0 : 2) : (w.y >= w.z ? 1 : 2);
  for (PointScalar& scalar : points.scalars) {
    double value = scalar.values[t[static_cast<std::size_t>(nearest)]];
    if (!scalar.is_label)
      value = w.x * scalar.values[t[0]] + w.y * scalar.values[t[1]] + w.z * scalar.values[t[2]];
    scalar.values.push_back(value);
  }
}

/// Calls `add(triangle, weights)` for the points on large ones of `triangles`, about `step` apart:
/// first those of edges that no earlier triangle had, then rows parallel to the longest edge. Ends
/// when `add` returns false, and returns whether it never did.
template <class Add>
bool for_each_added(const Points& points, const std::vector<std::uint32_t>& triangles,
                    double longest_left_alone, double step, const Add& add) {
  std::unordered_set<std::uint64_t> edges_done;
  for (const std::uint32_t k : triangles) {
    const Triangle& t = points.triangles[k];
    std::size_t longest = 0;
    std::array<double, 3> lengths{};  // of the edge from corner c to the next
    for (std::size_t c = 0; c < 3; ++c) {
      lengths[c] = glm::distance(points.positions[t[c]], points.positions[t[(c + 1) % 3]]);
      if (lengths[c] > lengths[longest]) longest = c;
    }
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t a = std::min(t[c], t[(c + 1) % 3]);
      const std::uint32_t b = std::max(t[c], t[(c + 1) % 3]);
      if (lengths[c] <= longest_left_alone || !edges_done.insert(std::uint64_t{a} << 32 | b).second)
        continue;
      const int pieces = count_pieces(lengths[c], step);
      for (int i = 1; i < pieces; ++i) {
        const double s = static_cast<double>(i) / pieces;
        if (!add({a, b, b}, {1.0 - s, s, 0.0})) return false;
      }
    }
    if (lengths[longest] <= longest_left_alone) continue;
    const Triangle turned{t[longest], t[(longest + 1) % 3], t[(longest + 2) % 3]};
    const glm::dvec3 base = points.positions[turned[1]] - points.positions[turned[0]];
    const glm::dvec3 side = points.positions[turned[2]] - points.positions[turned[0]];
    const int rows = count_pieces(glm::length(glm::cross(base, side)) / lengths[longest], step);
    for (int row = 1; row < rows; ++row) {
      const double up = static_cast<double>(row) / rows;
      const int pieces = count_pieces(lengths[longest] * (1.0 - up), step);
      for (int i = 1; i < pieces; ++i) {
        const double s = (1.0 - up) * i / pieces;
        if (!add(turned, {1.0 - up - s, s, up})) return false;
      }
    }
  }
  return true;
}

}  // namespace

double area_of_triangles(const Points& mesh) {
  std::vector<double> areas(mesh.triangles.size());
  tbb::parallel_for(std::size_t{0}, areas.size(), [&](std::size_t k) {
    const Triangle& t = mesh.triangles[k];
    const glm::dvec3 a = mesh.positions[t[0]];
    areas[k] = 0.5 * glm::length(glm::cross(mesh.positions[t[1]] - a, mesh.positions[t[2]] - a));
  });
  return std::accumulate(areas.begin(), areas.end(), 0.0);
}

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
    std::size_t count = 0;
    return for_each_added(points, large, kLongEdge * step, step, [&](const Triangle&, glm::dvec3) {
      return ++count <= kMaxAddedPerPoint * wanted;
    });
  };
  // Too many: coarser everywhere, instead of leaving some triangles empty.
  double step = spacing;
  while (!fits(step)) step *= 1.5;
  for_each_added(points, large, kLongEdge * step, step, [&](const Triangle& t, glm::dvec3 w) {
    append(points, t, w);
    return true;
  });
  return points.size() - given;
}

}  // namespace relief
