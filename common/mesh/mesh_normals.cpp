#include "common/mesh/mesh_normals.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "common/mesh/triangle_order.h"

namespace relief {
namespace {

bool usable(glm::vec3 normal) {
  const float length = glm::length(normal);
  return std::isfinite(length) && length > 1e-12F;
}

}  // namespace

std::vector<glm::vec3> normals_from_triangles(const Points& points) {
  std::vector<glm::dvec3> sums(points.size(), glm::dvec3(0.0));
  for (const Triangle& triangle : points.triangles) {
    // Rounding does not depend on where a triangle begins.
    const Triangle t = smallest_first(triangle);
    const glm::dvec3 a = points.positions[t[0]];
    const glm::dvec3 b = points.positions[t[1]];
    const glm::dvec3 c = points.positions[t[2]];
    const glm::dvec3 cross = glm::cross(b - a, c - a);
    const double length = glm::length(cross);
    if (!(length > 0.0)) continue;
    const glm::dvec3 normal = cross / length;
    const glm::dvec3 ab = glm::normalize(b - a);
    const glm::dvec3 bc = glm::normalize(c - b);
    const glm::dvec3 ca = glm::normalize(a - c);
    const double at_a = std::acos(std::clamp(-glm::dot(ca, ab), -1.0, 1.0));
    const double at_b = std::acos(std::clamp(-glm::dot(ab, bc), -1.0, 1.0));
    sums[t[0]] += at_a * normal;
    sums[t[1]] += at_b * normal;
    sums[t[2]] += std::max(std::numbers::pi - at_a - at_b, 0.0) * normal;
  }
  std::vector<glm::vec3> normals(points.size(), glm::vec3(0.0F));
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const double length = glm::length(sums[i]);
    if (length > 1e-9) normals[i] = glm::vec3(sums[i] / length);
  }
  return normals;
}

std::vector<glm::vec3> vertex_normals(const Points& points) {
  std::vector<glm::vec3> normals = points.normals;
  if (normals.empty() || !std::all_of(normals.begin(), normals.end(), usable)) {
    const std::vector<glm::vec3> means = normals_from_triangles(points);
    normals.resize(means.size(), glm::vec3(0.0F));
    for (std::size_t k = 0; k < means.size(); ++k) {
      if (!usable(normals[k])) normals[k] = means[k];
    }
  }
  for (glm::vec3& normal : normals) {
    if (usable(normal)) normal = glm::normalize(normal);
  }
  return normals;
}

}  // namespace relief
