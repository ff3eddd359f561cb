#include "common/seams/vertex_grid.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace relief {

VertexGrid::VertexGrid(const std::vector<BorderVertex>& vertices) : vertices_(vertices) {
  if (vertices.empty()) return;
  double spacing = 0.0;
  origin_ = vertices.front().position;
  for (const BorderVertex& v : vertices) {
    spacing += v.spacing;
    longest_edge_ = std::max(longest_edge_, v.spacing);
  }
  longest_edge_ *= std::sqrt(1.0 + kSteepestJoined * kSteepestJoined);
  side_ = 3.0 * spacing / static_cast<double>(vertices.size());
  std::vector<std::uint64_t> keys(vertices.size());
  for (std::size_t v = 0; v < vertices.size(); ++v) keys[v] = key_of(cube_of(vertices[v].position));
  order_.resize(vertices.size());
  std::iota(order_.begin(), order_.end(), 0U);
  std::stable_sort(order_.begin(), order_.end(),
                   [&keys](std::uint32_t a, std::uint32_t b) { return keys[a] < keys[b]; });
  runs_.reserve(vertices.size());
  for (std::uint32_t k = 0; k < order_.size();) {
    Run run{k, k};
    while (run.end < order_.size() && keys[order_[run.end]] == keys[order_[k]]) ++run.end;
    runs_.emplace(keys[order_[k]], run);
    k = run.end;
  }
}

VertexGrid::Cube VertexGrid::cube_of(glm::dvec3 position) const {
  // Beyond this, doubles no longer tell neighbouring cubes apart. Also where it is not a number.
  static constexpr double kFarthest = 4.5e15;
  const auto whole = [](double x) {
    if (!(x > -kFarthest)) return static_cast<std::int64_t>(-kFarthest);
    return static_cast<std::int64_t>(std::floor(std::min(x, kFarthest)));
  };
  const glm::dvec3 at = (position - origin_) / side_;
  return {whole(at.x), whole(at.y), whole(at.z)};
}

}  // namespace relief
