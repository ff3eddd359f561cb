#include "common/seams/border_parts.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "common/disjoint_sets.h"

namespace relief {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// The nodes of a patch that triangles connect. An edge between two whole cells is joined once.
DisjointSets join_nodes(const Patch& patch, const CellTriangles& cells) {
  DisjointSets nodes(patch.heights.size());
  for (std::uint32_t j = 0; j < cells.rows; ++j) {
    for (std::uint32_t i = 0; i < cells.columns; ++i) {
      const std::uint32_t n00 = j * patch.width + i;
      // i - 1 and j - 1 of the first wrap around to what is outside.
      if (cells.at(i, j) == kWholeCell && cells.at(i - 1, j) == kWholeCell &&
          cells.at(i, j - 1) == kWholeCell) {
        nodes.join(n00, n00 + patch.width + 1);
        continue;
      }
      for_each_triangle(patch, cells, i, j, [&](const auto& t) {
        nodes.join(t[0], t[1]);
        nodes.join(t[1], t[2]);
      });
    }
  }
  return nodes;
}

}  // namespace

void find_parts(std::span<const Patch> patches, std::span<const CellTriangles> cells,
                BorderMesh& mesh) {
  mesh.parts.resize(mesh.vertices.size());
  tbb::parallel_for(std::size_t{0}, patches.size(), [&](std::size_t p) {
    const auto begin = std::ranges::lower_bound(mesh.vertices, p, {}, &BorderVertex::patch);
    const auto end = std::ranges::upper_bound(mesh.vertices, p, {}, &BorderVertex::patch);
    DisjointSets nodes = join_nodes(patches[p], cells[p]);
    std::vector<std::uint32_t> first_of(patches[p].heights.size(), kNone);
    for (auto v = begin; v != end; ++v) {
      const auto number = static_cast<std::uint32_t>(v - mesh.vertices.begin());
      std::uint32_t& first = first_of[nodes.find(v->node)];
      first = std::min(first, number);
      mesh.parts[number] = first;
    }
  });
}

}  // namespace relief
