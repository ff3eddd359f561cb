#include "preprocess/mesh_fit/mesh_sides.h"

#include <algorithm>
#include <cassert>
#include <map>

namespace relief {
namespace {

/// The points of each side, ascending.
std::map<std::uint32_t, std::vector<std::uint32_t>> points_of_sides(
    const std::vector<std::uint32_t>& sides) {
  std::map<std::uint32_t, std::vector<std::uint32_t>> points;
  for (std::uint32_t i = 0; i < sides.size(); ++i) points[sides[i]].push_back(i);
  return points;
}

}  // namespace

std::vector<std::uint8_t> take_small_sides(MeshSides& sides) {
  std::map<std::uint32_t, std::size_t> counts;
  for (const std::uint32_t side : sides.of_points) ++counts[side];
  const auto is_small = [&](std::uint32_t side) {
    const auto count = counts.find(side);
    return count == counts.end() || count->second <= kSurfaceNeighbours;
  };
  std::ranges::replace_if(sides.of_triangles, is_small, kAnySide);
  std::vector<std::uint8_t> are_of_small;
  are_of_small.reserve(sides.of_points.size());
  for (const std::uint32_t side : sides.of_points) are_of_small.push_back(is_small(side) ? 1 : 0);
  return are_of_small;
}

NeighbourGraph find_neighbours_on_sides(const std::vector<glm::dvec3>& positions,
                                        const std::vector<std::uint32_t>& sides) {
  NeighbourGraph graph;
  graph.k = kSurfaceNeighbours;
  graph.indices.resize(positions.size() * graph.k);
  graph.spacing.resize(positions.size());
  for (const auto& side : points_of_sides(sides)) {
    const std::vector<std::uint32_t>& points = side.second;
    std::vector<glm::dvec3> of_side;
    of_side.reserve(points.size());
    for (const std::uint32_t i : points) of_side.push_back(positions[i]);
    const NeighbourGraph part = find_neighbours(of_side, kSurfaceNeighbours);
    assert(part.k == graph.k);
    for (std::size_t m = 0; m < points.size(); ++m) {
      std::uint32_t* const out = graph.indices.data() + std::size_t{points[m]} * graph.k;
      for (std::uint32_t n = 0; n < graph.k; ++n) out[n] = points[part.of(m)[n]];
      graph.spacing[points[m]] = part.spacing[m];
    }
  }
  return graph;
}

std::uint32_t side_of(const MeshSides& sides, std::span<const std::uint32_t> points) {
  assert(!points.empty());
  return sides.of_points[points.front()];
}

}  // namespace relief
