#include "common/seams/seam_distances.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>

namespace relief {
namespace {

/// The squared distance of a point to a triangle (Ericson 2005, "Real-Time Collision Detection",
/// 5.1.5: the region of the triangle's plane that the point lies over).
double squared_distance(glm::dvec3 p, const std::array<glm::dvec3, 3>& t) {
  const glm::dvec3 ab = t[1] - t[0];
  const glm::dvec3 ac = t[2] - t[0];
  const auto to = [p](glm::dvec3 q) { return glm::dot(p - q, p - q); };
  const double d1 = glm::dot(ab, p - t[0]);
  const double d2 = glm::dot(ac, p - t[0]);
  if (d1 <= 0.0 && d2 <= 0.0) return to(t[0]);
  const double d3 = glm::dot(ab, p - t[1]);
  const double d4 = glm::dot(ac, p - t[1]);
  if (d3 >= 0.0 && d4 <= d3) return to(t[1]);
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return to(t[0] + d1 / (d1 - d3) * ab);
  const double d5 = glm::dot(ab, p - t[2]);
  const double d6 = glm::dot(ac, p - t[2]);
  if (d6 >= 0.0 && d5 <= d6) return to(t[2]);
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return to(t[0] + d2 / (d2 - d6) * ac);
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 >= d3 && d5 >= d6)
    return to(t[1] + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (t[2] - t[1]));
  return to(t[0] + (vb * ab + vc * ac) / (va + vb + vc));
}

}  // namespace

SeamDistances::SeamDistances(std::span<const Patch> patches, const Seams& seams) {
  double spacing = 0.0;
  for (const Patch& patch : patches) spacing = std::max(spacing, patch.spacing);
  side_ = 2.0 * spacing;
  for (std::size_t p = 0; p < patches.size(); ++p) {
    const Patch& patch = patches[p];
    for (const Triangle& t : seams.triangles[p]) {
      Corners corners{};
      for (std::size_t c = 0; c < 3; ++c) {
        corners[c] = (t[c] & kSeamVertexBit) != 0
                         ? seams.vertices[t[c] & ~kSeamVertexBit].position
                         : position_of(patch, t[c] % patch.width, t[c] / patch.width);
      }
      triangles_.push_back(corners);
    }
  }
  if (triangles_.empty()) return;
  origin_ = triangles_.front()[0];
  std::vector<std::uint64_t> keys;
  keys.reserve(triangles_.size());
  for (const Corners& t : triangles_)
    keys.push_back(cube_of((t[0] + t[1] + t[2]) / 3.0, {0, 0, 0}));
  std::vector<std::uint32_t> order(triangles_.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(),
                   [&keys](std::uint32_t a, std::uint32_t b) { return keys[a] < keys[b]; });
  std::vector<Corners> sorted;
  sorted.reserve(order.size());
  for (const std::uint32_t k : order) {
    const auto at = static_cast<std::uint32_t>(sorted.size());
    runs_.try_emplace(keys[k], std::array{at, at}).first->second[1] = at + 1;
    sorted.push_back(triangles_[k]);
  }
  triangles_ = std::move(sorted);
}

std::uint64_t SeamDistances::cube_of(glm::dvec3 position, glm::ivec3 offset) const {
  const glm::dvec3 cube = glm::floor((position - origin_) / side_);
  constexpr std::uint64_t mask = (1U << 21U) - 1;
  const auto bits = [&](double at, int step) {
    return (static_cast<std::uint64_t>(static_cast<std::int64_t>(at)) +
            static_cast<std::uint64_t>(step)) &
           mask;
  };
  return bits(cube.x, offset.x) << 42U | bits(cube.y, offset.y) << 21U | bits(cube.z, offset.z);
}

std::optional<double> SeamDistances::find(glm::dvec3 point) const {
  double least = std::numeric_limits<double>::infinity();
  for (int z = -1; z <= 1; ++z) {
    for (int y = -1; y <= 1; ++y) {
      for (int x = -1; x <= 1; ++x) {
        const auto found = runs_.find(cube_of(point, {x, y, z}));
        if (found == runs_.end()) continue;
        for (std::uint32_t k = found->second[0]; k < found->second[1]; ++k)
          least = std::min(least, squared_distance(point, triangles_[k]));
      }
    }
  }
  if (!std::isfinite(least)) return {};
  return std::sqrt(least);
}

}  // namespace relief
