#include "common/seams/seam_distances.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

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
  std::vector<glm::dvec3> middles;
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
      middles.push_back((corners[0] + corners[1] + corners[2]) / 3.0);
    }
  }
  cubes_ = CubeRuns(middles, 2.0 * spacing);
  spheres_.reserve(middles.size());
  for (const std::uint32_t t : cubes_.order()) {
    double radius = 0.0;
    for (const glm::dvec3& corner : triangles_[t])
      radius = std::max(radius, glm::distance(corner, middles[t]));
    spheres_.push_back({middles[t], 1.001 * radius});  // a little more, for rounding
  }
}

std::optional<double> SeamDistances::find(glm::dvec3 point, double within) const {
  double least = within * within;
  bool found = false;
  const Cube at = cubes_.cube_of(point);
  for (std::int64_t z = at.z - 1; z <= at.z + 1; ++z) {
    for (std::int64_t y = at.y - 1; y <= at.y + 1; ++y) {
      const CubeRuns::Run run = cubes_.in_row(at.x - 1, at.x + 1, y, z);
      for (std::uint32_t k = run.first; k < run.first + run.count; ++k) {
        const glm::dvec3 d = point - spheres_[k].middle;
        const double reach = within + spheres_[k].radius;
        if (glm::dot(d, d) > reach * reach) continue;
        const double squared = squared_distance(point, triangles_[cubes_.order()[k]]);
        if (squared >= least) continue;
        least = squared;
        within = std::sqrt(squared);
        found = true;
      }
    }
  }
  if (!found) return {};
  return within;
}

}  // namespace relief
