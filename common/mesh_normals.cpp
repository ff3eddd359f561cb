#include "common/mesh_normals.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace relief {

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

}  // namespace relief
