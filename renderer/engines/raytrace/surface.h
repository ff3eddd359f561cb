// What a mesh is at the position where a ray meets one of its triangles.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "renderer/engines/raytrace/embree_scene.h"
#include "renderer/geometry/meshes/triangle_mesh.h"

namespace relief::raytrace {

/// Attributes there, linear over the triangle; normals are made unit vectors. A texture, where
/// there is one, has the colour, and a normal map the normal (bilinear at their finest level:
/// several rays a pixel filter what they make).
/// What is no number or missing in the mesh becomes a neutral grey, opaque; the triangle's own
/// normal; and 0.
[[nodiscard]] glm::vec4 colour_at(const TriangleMesh& mesh, const Hit& at);
[[nodiscard]] glm::vec3 normal_at(const TriangleMesh& mesh, const Hit& at);
/// Whether a ray in that direction meets the back of the triangle, the side that its normal there
/// points away from.
[[nodiscard]] bool is_from_behind(const TriangleMesh& mesh, const Hit& at, glm::vec3 normal,
                                  glm::dvec3 direction);
[[nodiscard]] glm::vec2 uv_at(const TriangleMesh& mesh, const Hit& at);
[[nodiscard]] std::uint32_t patch_at(const TriangleMesh& mesh, const Hit& at);
/// The diameter of the sphere about the model that it belongs to (TriangleMesh::bodies, of which
/// there are some).
[[nodiscard]] double body_at(const std::vector<MeshBody>& bodies, const TriangleMesh& mesh,
                             const Hit& at);
[[nodiscard]] std::uint8_t material_at(const TriangleMesh& mesh, const Hit& at);

}  // namespace relief::raytrace
