#include "renderer/mesh_of_points.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "common/mesh_normals.h"
#include "common/srgb.h"

namespace relief {
namespace {

bool usable(glm::vec3 normal) {
  const float length = glm::length(normal);
  return std::isfinite(length) && length > 1e-12F;
}

}  // namespace

TriangleMesh mesh_of_points(const Points& points) {
  TriangleMesh mesh;
  mesh.positions = points.positions;
  mesh.triangles = points.triangles;
  mesh.normals = points.normals;
  if (!std::all_of(mesh.normals.begin(), mesh.normals.end(), usable) || mesh.normals.empty()) {
    const std::vector<glm::vec3> means = normals_from_triangles(points);
    mesh.normals.resize(means.size(), glm::vec3(0.0F));
    for (std::size_t k = 0; k < means.size(); ++k) {
      if (!usable(mesh.normals[k])) mesh.normals[k] = means[k];
    }
  }
  for (glm::vec3& normal : mesh.normals) {
    if (usable(normal)) normal = glm::normalize(normal);
  }
  mesh.colours.reserve(points.colours.size());
  for (const glm::u8vec3& colour : points.colours)
    mesh.colours.emplace_back(linear_from_srgb8(colour), 1.0F);
  return mesh;
}

}  // namespace relief
