#include <algorithm>
#include <cassert>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <utility>

#include "common/is_finite.h"
#include "common/mesh/seen_positions.h"
#include "common/mesh/sharp_mesh.h"
#include "preprocess/points/keep_points.h"
#include "preprocess/readers/read_points.h"
#include "preprocess/readers/source.h"

namespace relief {
namespace {

// Normals that are nearer to each other, half a degree, are one.
constexpr float kSameCosine = 0.99996F;

bool has_same_normal(const Points& points, std::uint32_t a, std::uint32_t b) {
  const glm::vec3 n = points.normals[a];
  const glm::vec3 m = points.normals[b];
  const float lengths = glm::length(n) * glm::length(m);
  return !(lengths > 0.0F) || glm::dot(n, m) >= kSameCosine * lengths;
}

/// Formats with one texture coordinate a point repeat the points of a seam for each side. Merged
/// points keep one side's, so the triangles get their corners' own.
void keep_seams(Points& points) {
  const auto count = points.size();
  points.corner_texcoords.reserve(points.triangles.size());
  for (const Triangle& t : points.triangles) {
    CornerTexcoords corners{};
    for (std::size_t c = 0; c < 3; ++c) {
      if (t[c] < count) corners[c] = points.texcoords[t[c]];
    }
    points.corner_texcoords.push_back(corners);
  }
}

}  // namespace

ReadResult clean_points(Points points, std::vector<std::uint32_t>* number) {
  assert(points.size() < kNoPoint &&
         "readers and callers refuse more points than 32 bits can index");
  ReadResult result;
  result.points_in_file = points.size();
  const auto count = static_cast<std::uint32_t>(points.size());
  std::vector<std::uint32_t> new_index(count, kNoPoint);
  std::vector<std::uint32_t> kept;
  kept.reserve(count);
  SeenPositions seen(count);
  // Triangles of a design show whether the edge between them is sharp; those of a scan don't.
  const bool keeps_normals = !points.normals.empty() && is_designed_mesh(points);
  bool seam = false;
  for (std::uint32_t i = 0; i < count; ++i) {
    if (!is_finite(points.positions[i])) {
      ++result.dropped_nonfinite;
      continue;
    }
    const std::uint32_t first = seen.find_or_add(points.positions, i, [&](std::uint32_t earlier) {
      return !keeps_normals || has_same_normal(points, earlier, i);
    });
    if (first == i) {
      new_index[i] = static_cast<std::uint32_t>(kept.size());
      kept.push_back(i);
      continue;
    }
    ++result.merged_duplicates;
    new_index[i] = new_index[first];
    seam = seam || (!points.texcoords.empty() && points.texcoords[i] != points.texcoords[first]);
    add_normal(points, first, i);
  }
  if (seam && points.corner_texcoords.empty()) keep_seams(points);
  keep_points(points, kept, new_index);
  result.points = std::move(points);
  if (number != nullptr) *number = std::move(new_index);
  return result;
}

}  // namespace relief
