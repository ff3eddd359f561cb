#include "common/seams/vertex_grid.h"

#include <algorithm>
#include <cmath>

namespace relief {

VertexGrid::VertexGrid(const std::vector<BorderVertex>& vertices) : vertices_(vertices) {
  if (vertices.empty()) return;
  double spacing = 0.0;
  std::vector<glm::dvec3> positions;
  positions.reserve(vertices.size());
  for (const BorderVertex& v : vertices) {
    positions.push_back(v.position);
    spacing += v.spacing;
    longest_edge_ = std::max(longest_edge_, v.spacing);
  }
  longest_edge_ *= std::sqrt(1.0 + kSteepestJoined * kSteepestJoined);
  cubes_ = CubeRuns(positions, 3.0 * spacing / static_cast<double>(vertices.size()));
}

}  // namespace relief
