#include "preprocess/texture/flat_triangles.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace relief {
namespace {

/// In cells squared; what is thinner has no place for a texel.
constexpr double kLeastArea = 1e-12;

double cross(glm::dvec2 a, glm::dvec2 b) {
  return a.x * b.y - a.y * b.x;
}

/// The lowest and the highest sample of a patch, height indices.
glm::ivec2 height_range(const Patch& patch) {
  glm::ivec2 range(kMaxHeightRange, 0);
  for (const std::int32_t h : patch.heights) {
    if (h != kHole) range = {std::min(range.x, h), std::max(range.y, h)};
  }
  return range;
}

}  // namespace

glm::dvec3 FlatTriangle::weights_at(glm::dvec2 place) const {
  const glm::dvec2 a = corners[0] - place;
  const glm::dvec2 b = corners[1] - place;
  const glm::dvec2 c = corners[2] - place;
  return glm::dvec3(cross(b, c), cross(c, a), cross(a, b)) / twice_area;
}

double FlatTriangle::twice_area_in_space() const {
  const glm::dvec3 b(corners[1] - corners[0], heights.y - heights.x);
  const glm::dvec3 c(corners[2] - corners[0], heights.z - heights.x);
  return glm::length(glm::cross(b, c));
}

TriangleSpheres::TriangleSpheres(const Points& mesh) : mesh_(mesh) {
  const Bounds bounds = bounds_of(mesh.positions);
  middle_ = 0.5 * (bounds.min + bounds.max);
  spheres_.reserve(mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    const glm::dvec3 a = mesh.positions[t[0]] - middle_;
    const glm::dvec3 b = mesh.positions[t[1]] - middle_;
    const glm::dvec3 c = mesh.positions[t[2]] - middle_;
    const glm::dvec3 centre = (a + b + c) / 3.0;
    const double radius =
        std::max({glm::distance(a, centre), glm::distance(b, centre), glm::distance(c, centre)});
    // Single precision rounds the centre by less than a millionth of its distance.
    spheres_.push_back(
        {glm::vec3(centre), static_cast<float>(radius + 1e-6 * glm::length(centre))});
  }
}

std::vector<FlatTriangle> TriangleSpheres::find_over(const Patch& patch) const {
  const glm::ivec2 range = height_range(patch);
  const glm::dvec2 cells(patch.width - 1, patch.height - 1);
  const double rise = (range.y - range.x) * patch.height_step / patch.spacing;
  const glm::dvec3 local(0.5 * cells,
                         0.5 * (range.x + range.y) * patch.height_step / patch.spacing);
  const glm::dvec3 centre = patch.origin - middle_ + patch.axes * (patch.spacing * local);
  const double radius = patch.spacing * (0.5 * glm::length(glm::dvec3(cells, rise)) + kTexelReach);
  const glm::dmat3 to_local = glm::transpose(patch.axes);
  std::vector<FlatTriangle> found;
  for (std::size_t t = 0; t < spheres_.size(); ++t) {
    const glm::vec3 apart = spheres_[t].centre - glm::vec3(centre);
    const float reach = spheres_[t].radius + static_cast<float>(radius) * 1.0001F;
    if (glm::dot(apart, apart) > reach * reach) continue;
    FlatTriangle flat;
    flat.index = static_cast<std::uint32_t>(t);
    glm::dvec2 low(INFINITY);
    glm::dvec2 high(-INFINITY);
    for (std::size_t c = 0; c < 3; ++c) {
      const glm::dvec3 place =
          to_local * (mesh_.positions[mesh_.triangles[t][c]] - patch.origin) / patch.spacing;
      flat.corners[c] = glm::dvec2(place);
      flat.heights[static_cast<glm::length_t>(c)] = place.z;
      low = glm::min(low, flat.corners[c]);
      high = glm::max(high, flat.corners[c]);
    }
    if (low.x > cells.x || low.y > cells.y || high.x < 0.0 || high.y < 0.0) continue;
    flat.twice_area = cross(flat.corners[1] - flat.corners[0], flat.corners[2] - flat.corners[0]);
    if (std::abs(flat.twice_area) > kLeastArea) found.push_back(flat);
  }
  return found;
}

}  // namespace relief
