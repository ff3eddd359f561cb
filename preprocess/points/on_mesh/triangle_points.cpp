#include "preprocess/points/on_mesh/triangle_points.h"

namespace relief {

void append_point(const Points& mesh, const Triangle& t, glm::dvec3 weights, Points& points) {
  const auto mix = [&](const auto& values, auto zero) {
    for (glm::length_t c = 0; c < 3; ++c) {
      zero += static_cast<typename decltype(zero)::value_type>(weights[c]) *
              decltype(zero)(values[t[static_cast<std::size_t>(c)]]);
    }
    return zero;
  };
  points.positions.push_back(mix(mesh.positions, glm::dvec3(0.0)));
  if (!mesh.normals.empty()) points.normals.push_back(mix(mesh.normals, glm::vec3(0.0F)));
  if (!mesh.colours.empty()) points.colours.emplace_back(mix(mesh.colours, glm::vec3(0.0F)) + 0.5F);
  if (!mesh.texcoords.empty()) points.texcoords.push_back(mix(mesh.texcoords, glm::vec2(0.0F)));
  const glm::length_t nearest =
      weights.x >= weights.y ? (weights.x >= weights.z ? 0 : 2) : (weights.y >= weights.z ? 1 : 2);
  for (std::size_t s = 0; s < mesh.scalars.size(); ++s) {
    const PointScalar& scalar = mesh.scalars[s];
    double value = scalar.values[t[static_cast<std::size_t>(nearest)]];
    if (!scalar.is_label) {
      value = weights.x * scalar.values[t[0]] + weights.y * scalar.values[t[1]] +
              weights.z * scalar.values[t[2]];
    }
    points.scalars[s].values.push_back(value);
  }
}

}  // namespace relief
