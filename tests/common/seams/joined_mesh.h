// The surface of patches that meet, as one mesh whose vertices are shared.
#pragma once

#include <array>
#include <cstdint>
#include <glm/geometric.hpp>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "common/patch.h"
#include "common/seams/cell_triangles.h"
#include "common/seams/make_seams.h"

namespace relief::test {

struct JoinedMesh {
  std::vector<glm::dvec3> positions;
  std::vector<Triangle> triangles;

  /// How often each directed edge occurs.
  [[nodiscard]] std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges() const {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> counts;
    for (const Triangle& t : triangles) {
      for (std::size_t c = 0; c < 3; ++c) ++counts[{t[c], t[(c + 1) % 3]}];
    }
    return counts;
  }

  /// Directed edges without an opposite one.
  [[nodiscard]] std::vector<std::pair<std::uint32_t, std::uint32_t>> open_edges() const {
    const auto all = edges();
    std::vector<std::pair<std::uint32_t, std::uint32_t>> open;
    for (const auto& [edge, count] : all) {
      if (!all.contains({edge.second, edge.first})) open.push_back(edge);
    }
    return open;
  }

  [[nodiscard]] double area() const {
    double sum = 0.0;
    for (const Triangle& t : triangles) sum += 0.5 * glm::length(normal_of(t));
    return sum;
  }

  /// Not unit: twice the area long.
  [[nodiscard]] glm::dvec3 normal_of(const Triangle& t) const {
    return glm::cross(positions[t[1]] - positions[t[0]], positions[t[2]] - positions[t[0]]);
  }
};

inline JoinedMesh joined_mesh(std::span<const Patch> patches, bool is_closed = false) {
  const Seams seams = make_seams(patches, is_closed);
  JoinedMesh mesh;
  for (const SeamVertex& vertex : seams.vertices) mesh.positions.push_back(vertex.position);
  for (std::size_t p = 0; p < patches.size(); ++p) {
    const Patch& patch = patches[p];
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (std::uint32_t node = 0; node < patch.heights.size(); ++node)
      mesh.positions.push_back(patch.heights[node] == kHole
                                   ? glm::dvec3(0.0)
                                   : position_of(patch, node % patch.width, node / patch.width));
    const auto add = [&](const Triangle& corners) {
      Triangle t{};
      for (std::size_t c = 0; c < 3; ++c)
        t[c] =
            (corners[c] & kSeamVertexBit) != 0 ? corners[c] & ~kSeamVertexBit : first + corners[c];
      mesh.triangles.push_back(t);
    };
    const CellTriangles cells = cell_triangles(patch);
    for (std::uint32_t j = 0; j < cells.rows; ++j) {
      for (std::uint32_t i = 0; i < cells.columns; ++i) {
        if (cells.at(i, j) == kWholeCell) for_each_triangle(patch, cells, i, j, add);
      }
    }
    for (const Triangle& t : seams.triangles[p]) add(t);
  }
  return mesh;
}

}  // namespace relief::test
