// Meshes with known surfaces, and images of them, for the ray tracer's tests.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/vec3.hpp>

#include "renderer/geometry/meshes/triangle_mesh.h"
#include "tests/renderer/images.h"

namespace relief::test {

/// Adds a parallelogram a, a + u, a + u + v, a + v of one colour; its normal is that of u x v.
inline void add_sheet(TriangleMesh& mesh, glm::dvec3 a, glm::dvec3 u, glm::dvec3 v,
                      glm::vec4 colour = {0.5F, 0.5F, 0.5F, 1.0F}) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const glm::dvec3& p : {a, a + u, a + u + v, a + v}) {
    mesh.positions.push_back(p);
    mesh.normals.emplace_back(glm::normalize(glm::cross(u, v)));
    mesh.colours.push_back(colour);
  }
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first, first + 2, first + 3});
}

/// The unit sphere about `centre` with `rings` rings of twice as many quads, each two triangles.
inline TriangleMesh sphere_mesh(std::uint32_t rings, glm::dvec3 centre = {}) {
  TriangleMesh mesh;
  const std::uint32_t columns = 2 * rings;
  for (std::uint32_t j = 0; j <= rings; ++j) {
    for (std::uint32_t i = 0; i < columns; ++i) {
      const double theta = glm::pi<double>() * j / rings;
      const double phi = glm::two_pi<double>() * i / columns;
      const glm::dvec3 d(std::sin(theta) * std::sin(phi), std::cos(theta),
                         std::sin(theta) * std::cos(phi));
      mesh.positions.push_back(centre + d);
      mesh.normals.emplace_back(d);
    }
  }
  for (std::uint32_t j = 0; j < rings; ++j) {
    for (std::uint32_t i = 0; i < columns; ++i) {
      const std::uint32_t a = j * columns + i;
      const std::uint32_t b = j * columns + (i + 1) % columns;
      mesh.triangles.push_back({a, a + columns, b + columns});
      mesh.triangles.push_back({a, b + columns, b});
    }
  }
  return mesh;
}

/// Settings for a traced image, one ray a pixel, all outputs, transparent background.
inline RenderSettings traced_image(const Camera& camera, std::uint32_t width = 96,
                                   std::uint32_t height = 80) {
  RenderSettings settings;
  settings.engine = "raytrace";
  settings.width = width;
  settings.height = height;
  settings.camera = camera;
  settings.background.reset();
  settings.outputs = all_outputs();
  settings.raytrace.samples = 1;
  settings.frames = 1;
  return settings;
}

/// Renders; a failure fails the test and gives an empty image.
inline RenderResult must_trace(const TriangleMesh& mesh, const RenderSettings& settings) {
  Progress silent;
  auto result = render(mesh, settings, silent);
  if (result) return *result;
  ADD_FAILURE() << result.error().message;
  return {};
}

inline glm::dvec3 normal_of(const Image& image, std::size_t k) {
  return {values(image, "N.X")[k], values(image, "N.Y")[k], values(image, "N.Z")[k]};
}

/// The angle between two unit vectors, degrees.
inline double degrees_between(glm::dvec3 a, glm::dvec3 b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 180.0 / glm::pi<double>();
}

}  // namespace relief::test
