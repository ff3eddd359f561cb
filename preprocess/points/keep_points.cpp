#include "preprocess/points/keep_points.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <span>

#include "common/is_finite.h"
#include "common/mesh/triangle_order.h"
#include "preprocess/points/no_point.h"

namespace relief {
namespace {

/// Closes the gaps of dropped points. `kept` lists the points to keep, ascending.
template <class T>
void compact(std::vector<T>& values, const std::vector<std::uint32_t>& kept) {
  if (values.empty()) return;
  for (std::size_t i = 0; i < kept.size(); ++i) values[i] = values[kept[i]];
  values.resize(kept.size());
}

Triangle renumbered(Triangle t, const std::vector<std::uint32_t>& new_index) {
  for (std::uint32_t& corner : t) corner = corner < new_index.size() ? new_index[corner] : kNoPoint;
  return t;
}

bool is_whole(const Triangle& t) {
  return std::ranges::find(t, kNoPoint) == t.end() && t[0] != t[1] && t[1] != t[2] && t[2] != t[0];
}

/// Marks triangles that repeat an earlier one: the same corners in the same order, from wherever
/// one begins. Sorting them takes a third of the time of a table of all.
void mark_repeated(const std::vector<Triangle>& triangles, std::size_t points,
                   std::vector<std::uint8_t>& dropped) {
  TriangleOrder order = order_triangles(triangles, points, dropped);
  tbb::parallel_for(std::size_t{0}, points, [&](std::size_t corner) {
    const std::span own = order.at(corner);
    for (std::size_t k = 1; k < own.size(); ++k) {
      if (smallest_first(triangles[own[k]]) == smallest_first(triangles[own[k - 1]]))
        dropped[own[k]] = 1;
    }
  });
}

/// Renumbers triangles and drops those with a lost or invalid corner, with two equal corners, or
/// that repeat an earlier one.
void renumber(Points& points, const std::vector<std::uint32_t>& new_index) {
  std::vector<Triangle>& triangles = points.triangles;
  std::vector<std::uint8_t> dropped(triangles.size());
  tbb::parallel_for(std::size_t{0}, triangles.size(), [&](std::size_t k) {
    triangles[k] = renumbered(triangles[k], new_index);
    dropped[k] = is_whole(triangles[k]) ? 0 : 1;
  });
  mark_repeated(triangles, new_index.size(), dropped);
  if (std::ranges::find(dropped, 1) == dropped.end()) return;
  std::vector<std::uint32_t> kept;
  kept.reserve(triangles.size());
  for (std::uint32_t k = 0; k < triangles.size(); ++k) {
    if (dropped[k] == 0) kept.push_back(k);
  }
  compact(triangles, kept);
  compact(points.corner_texcoords, kept);
  compact(points.corner_tangents, kept);
  compact(points.triangle_materials, kept);
}

}  // namespace

void keep_points(Points& points, const std::vector<std::uint32_t>& kept,
                 const std::vector<std::uint32_t>& new_index) {
  renumber(points, new_index);
  if (kept.size() == points.size()) return;
  compact(points.positions, kept);
  compact(points.normals, kept);
  compact(points.colours, kept);
  compact(points.texcoords, kept);
  compact(points.scanner_of, kept);
  for (PointScalar& scalar : points.scalars) compact(scalar.values, kept);
}

void add_normal(Points& points, std::uint32_t to, std::uint32_t from) {
  if (points.normals.empty() || !is_finite(points.normals[from])) return;
  glm::vec3& normal = points.normals[to];
  normal = is_finite(normal) ? normal + points.normals[from] : points.normals[from];
}

std::vector<std::uint32_t> indices_after(const std::vector<std::uint8_t>& dropped) {
  std::vector<std::uint32_t> new_index(dropped.size(), kNoPoint);
  std::uint32_t kept = 0;
  for (std::size_t i = 0; i < dropped.size(); ++i) {
    if (dropped[i] == 0) new_index[i] = kept++;
  }
  return new_index;
}

std::uint64_t drop_points(Points& points, const std::vector<std::uint8_t>& dropped) {
  std::vector<std::uint32_t> kept;
  kept.reserve(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (dropped[i] == 0) kept.push_back(i);
  }
  const std::uint64_t count = points.size() - kept.size();
  if (count > 0) keep_points(points, kept, indices_after(dropped));
  return count;
}

}  // namespace relief
