#include "preprocess/points/keep_points.h"

#include <algorithm>

#include "preprocess/readers/source.h"

namespace relief {
namespace {

/// Closes the gaps of dropped points. `kept` lists the points to keep, ascending.
template <class T>
void compact(std::vector<T>& values, const std::vector<std::uint32_t>& kept) {
  if (values.empty()) return;
  for (std::size_t i = 0; i < kept.size(); ++i) values[i] = values[kept[i]];
  values.resize(kept.size());
}

/// Renumbers triangles and drops those with a lost or invalid corner or with two equal corners.
void renumber(Points& points, const std::vector<std::uint32_t>& new_index) {
  std::vector<Triangle>& triangles = points.triangles;
  std::size_t left = 0;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    Triangle t = triangles[i];
    for (std::uint32_t& corner : t) {
      corner = corner < new_index.size() ? new_index[corner] : kNoPoint;
    }
    const bool whole = std::ranges::find(t, kNoPoint) == t.end();
    if (!whole || t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
    if (!points.corner_texcoords.empty()) {
      points.corner_texcoords[left] = points.corner_texcoords[i];
    }
    if (!points.corner_tangents.empty()) points.corner_tangents[left] = points.corner_tangents[i];
    if (!points.triangle_materials.empty()) {
      points.triangle_materials[left] = points.triangle_materials[i];
    }
    triangles[left++] = t;
  }
  triangles.resize(left);
  if (!points.corner_texcoords.empty()) points.corner_texcoords.resize(left);
  if (!points.corner_tangents.empty()) points.corner_tangents.resize(left);
  if (!points.triangle_materials.empty()) points.triangle_materials.resize(left);
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
  for (PointScalar& scalar : points.scalars) compact(scalar.values, kept);
}

std::uint64_t drop_points(Points& points, const std::vector<std::uint8_t>& dropped) {
  std::vector<std::uint32_t> kept;
  std::vector<std::uint32_t> new_index(points.size(), kNoPoint);
  kept.reserve(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (dropped[i] != 0) continue;
    new_index[i] = static_cast<std::uint32_t>(kept.size());
    kept.push_back(i);
  }
  const std::uint64_t count = points.size() - kept.size();
  if (count > 0) keep_points(points, kept, new_index);
  return count;
}

}  // namespace relief
