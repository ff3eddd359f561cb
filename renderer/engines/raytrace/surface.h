// What a mesh is at the place where a ray meets one of its triangles.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "renderer/engines/raytrace/embree_scene.h"
#include "renderer/triangle_mesh.h"
#include "renderer/view.h"

namespace relief::raytrace {

struct Surface {
  double depth = 0.0;     ///< along the view axis
  glm::dvec3 place{0.0};  ///< barycentric weights of the triangle's corners
  bool front = true;      ///< whether its corners turn counter-clockwise as seen by the ray
  std::uint32_t triangle = 0;
};

/// Where the ray from the eye along `ray` (as ray_through gives it) meets the plane of a triangle,
/// in double precision, and not beyond the triangle's sides. A ray within the plane keeps the place
/// of single precision.
[[nodiscard]] Surface meet(const TriangleMesh& mesh, const View& view, glm::dvec3 ray,
                           const Candidate& candidate);

/// Attributes there, linear over the triangle. What is no number or missing in the mesh becomes a
/// neutral grey, opaque; the triangle's own normal; and 0.
[[nodiscard]] glm::vec4 colour_at(const TriangleMesh& mesh, const Surface& at);
[[nodiscard]] glm::vec3 normal_at(const TriangleMesh& mesh, const Surface& at);
[[nodiscard]] glm::vec2 uv_at(const TriangleMesh& mesh, const Surface& at);
[[nodiscard]] std::uint32_t patch_at(const TriangleMesh& mesh, const Surface& at);

}  // namespace relief::raytrace
