#include "common/seams/vertex_grid.h"

#include <algorithm>
#include <cmath>

namespace relief {

VertexGrid::VertexGrid(const std::vector<BorderVertex>& vertices,
                       const std::function<bool(std::uint32_t)>& holds) {
  if (vertices.empty()) return;
  double spacing = 0.0;
  std::vector<glm::dvec3> positions;
  std::vector<std::uint32_t> held;
  for (std::uint32_t v = 0; v < vertices.size(); ++v) {
    spacing += vertices[v].spacing;
    largest_spacing_ = std::max(largest_spacing_, vertices[v].spacing);
    if (!holds(v)) continue;
    positions.push_back(vertices[v].position);
    held.push_back(v);
  }
  longest_edge_ = largest_spacing_ * std::sqrt(1.0 + kSteepestJoined * kSteepestJoined);
  cubes_ = CubeRuns(positions, 3.0 * spacing / static_cast<double>(vertices.size()));
  places_.reserve(positions.size());
  for (const std::uint32_t k : cubes_.order())
    places_.push_back({positions[k], vertices[held[k]].normal, held[k]});
}

}  // namespace relief
