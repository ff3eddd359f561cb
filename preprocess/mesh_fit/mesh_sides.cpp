#include "preprocess/mesh_fit/mesh_sides.h"

#include <algorithm>
#include <cassert>
#include <glm/geometric.hpp>

#include "common/mesh/mesh_edges.h"

namespace relief {
namespace {

/// The points of each side, ascending.
std::map<std::uint32_t, std::vector<std::uint32_t>> points_of_sides(
    const std::vector<std::uint32_t>& sides) {
  std::map<std::uint32_t, std::vector<std::uint32_t>> points;
  for (std::uint32_t i = 0; i < sides.size(); ++i) points[sides[i]].push_back(i);
  return points;
}

/// The lengths of the borders of sides, to other sides and of the mesh.
std::map<std::uint32_t, double> borders_of_sides(const Points& mesh,
                                                 const std::vector<std::uint32_t>& sides) {
  std::map<std::uint32_t, double> borders;
  MeshEdges(mesh).for_each([&](std::uint32_t p, std::span<const EdgeUse> uses) {
    const auto side = [&](const EdgeUse& use) { return sides[use.triangle]; };
    if (uses.size() == 2 && side(uses[0]) == side(uses[1])) return;
    const double length = glm::distance(mesh.positions[p], mesh.positions[uses[0].greater]);
    for (const EdgeUse& use : uses) borders[side(use)] += length;
  });
  return borders;
}

}  // namespace

std::map<std::uint32_t, double> widths_of_sides(const Points& mesh,
                                                const std::vector<std::uint32_t>& sides) {
  std::map<std::uint32_t, double> twice_areas;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle& corners = mesh.triangles[t];
    const glm::dvec3 a = mesh.positions[corners[0]];
    twice_areas[sides[t]] +=
        glm::length(glm::cross(mesh.positions[corners[1]] - a, mesh.positions[corners[2]] - a));
  }
  std::map<std::uint32_t, double> widths;
  for (const auto& [side, length] : borders_of_sides(mesh, sides)) {
    if (length > 0.0) widths[side] = twice_areas[side] / length;
  }
  return widths;
}

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
