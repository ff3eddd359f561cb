#include "preprocess/readers/gltf/gltf_tangents.h"

#include <algorithm>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace relief {

Result<std::vector<glm::vec4>> read_tangents(const tinygltf::Model& model, int accessor,
                                             std::size_t count, const glm::dmat4& to_world) {
  RELIEF_TRY_ASSIGN(const auto given, read_accessor(model, accessor, 4));
  const glm::dmat3 turn(to_world);
  const float handedness = glm::determinant(turn) < 0.0 ? -1.0F : 1.0F;
  std::vector<glm::vec4> tangents;
  tangents.reserve(std::min(count, given.size() / 4));
  for (std::size_t k = 0; k < std::min(count, given.size() / 4); ++k) {
    const double* t = given.data() + 4 * k;
    tangents.emplace_back(glm::vec3(turn * glm::dvec3(t[0], t[1], t[2])),
                          handedness * static_cast<float>(t[3]));
  }
  return tangents;
}

std::vector<CornerTangents> by_corner(const std::vector<glm::vec4>& tangents,
                                      const std::vector<Triangle>& triangles) {
  std::vector<CornerTangents> corners(triangles.size(), CornerTangents{});
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t c = 0; c < 3; ++c) {
      if (triangles[t][c] < tangents.size()) corners[t][c] = tangents[triangles[t][c]];
    }
  }
  return corners;
}

}  // namespace relief
