#include "common/mesh/mesh_normals.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace relief {
namespace {

bool usable(glm::vec3 normal) {
  const float length = glm::length(normal);
  return std::isfinite(length) && length > 1e-12F;
}

}  // namespace

std::vector<glm::vec3> normals_from_triangles(const Points& points) {
  std::vector<glm::dvec3> sums(points.size(), glm::dvec3(0.0));
  for (const Triangle& t : points.triangles) {
    const glm::dvec3 p[3] = {points.positions[t[0]], points.positions[t[1]],
                             points.positions[t[2]]};
    const glm::dvec3 cross = glm::cross(p[1] - p[0], p[2] - p[0]);
    const double length = glm::length(cross);
    if (!(length > 0.0)) continue;
    for (int c = 0; c < 3; ++c) {
      const glm::dvec3 e = glm::normalize(p[(c + 1) % 3] - p[c]);
      const glm::dvec3 f = glm::normalize(p[(c + 2) % 3] - p[c]);
      sums[t[static_cast<std::size_t>(c)]] +=
          std::acos(std::clamp(glm::dot(e, f), -1.0, 1.0)) * cross / length;
    }
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
