#include "renderer/engines/raytrace/surface.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>

#include "common/mesh/mesh_tangents.h"
#include "common/mesh/mesh_texture.h"
#include "common/mesh/normal_texture.h"
#include "shaders/include/shared.h"

namespace relief::raytrace {
namespace {

/// The weighted sum of an attribute's values at the corners.
template <class Value>
auto blend(const std::vector<Value>& values, const Triangle& corners, glm::dvec3 weights) {
  using Wide = glm::vec<Value::length(), double>;
  return weights.x * Wide(values[corners[0]]) + weights.y * Wide(values[corners[1]]) +
         weights.z * Wide(values[corners[2]]);
}

glm::dvec2 texcoord_at(const TriangleMesh& mesh, const Hit& at) {
  const CornerTexcoords& corners = mesh.texcoords[at.triangle];
  return at.weights.x * glm::dvec2(corners[0]) + at.weights.y * glm::dvec2(corners[1]) +
         at.weights.z * glm::dvec2(corners[2]);
}

glm::vec3 texture_at(const TriangleMesh& mesh, const Hit& at) {
  const MeshMaterial& material = mesh.textures[mesh.triangle_textures[at.triangle]];
  if (material.texture == nullptr) return material.colour;
  return material.colour * material.texture->at(texcoord_at(mesh, at));
}

/// The normal map that a triangle has of its mesh file; null: none.
const MeshNormalMap* mesh_normals_at(const TriangleMesh& mesh, const Hit& at) {
  if (mesh.tangents.empty() || mesh.triangle_textures[at.triangle] == kNoMaterial) return nullptr;
  const MeshNormalMap& map = mesh.textures[mesh.triangle_textures[at.triangle]].normals;
  return map.texture == nullptr ? nullptr : &map;
}

/// 0 where there is none.
glm::dvec3 mesh_map_normal(const TriangleMesh& mesh, const MeshNormalMap& map, const Hit& at) {
  const Triangle& t = mesh.triangles[at.triangle];
  const TangentFrame frame =
      frame_at(mesh.tangents[at.triangle],
               {mesh.normals[t[0]], mesh.normals[t[1]], mesh.normals[t[2]]}, at.weights);
  return perturbed_normal(frame, map.texture->at(texcoord_at(mesh, at)), map.scale);
}

/// The normal that a patch's fine map has; 0 where there is none.
glm::dvec3 patch_map_normal(const TriangleMesh& mesh, const Hit& at) {
  const std::uint32_t patch = patch_at(mesh, at);
  if (patch == 0 || patch > mesh.patch_normals.size()) return glm::dvec3(0.0);
  const PatchNormalMap& map = mesh.patch_normals[patch - 1];
  if (map.texture == nullptr) return glm::dvec3(0.0);
  const glm::vec2 texel = uv_at(mesh, at) * map.scale + 0.5F;
  return map.axes * map.texture->at(texel / glm::vec2(map.texture->width(), map.texture->height()));
}

}  // namespace

glm::vec4 colour_at(const TriangleMesh& mesh, const Hit& at) {
  if (!mesh.triangle_textures.empty() && mesh.triangle_textures[at.triangle] != kNoMaterial)
    return {texture_at(mesh, at), 1.0F};
  const glm::vec4 grey(glm::vec3(shared::kNeutralGrey), 1.0F);
  if (mesh.colours.empty()) return grey;
  glm::vec4 colour(blend(mesh.colours, mesh.triangles[at.triangle], at.weights));
  if (!std::isfinite(colour.r + colour.g + colour.b + colour.a)) return grey;
  colour.a = std::clamp(colour.a, 0.0F, 1.0F);
  return colour;
}

bool is_from_behind(const TriangleMesh& mesh, const Hit& at, glm::vec3 normal,
                    glm::dvec3 direction) {
  const Triangle& t = mesh.triangles[at.triangle];
  const glm::dvec3 plane = glm::cross(mesh.positions[t[1]] - mesh.positions[t[0]],
                                      mesh.positions[t[2]] - mesh.positions[t[0]]);
  return glm::dot(plane, direction) * glm::dot(plane, glm::dvec3(normal)) > 0.0;
}

glm::vec3 normal_at(const TriangleMesh& mesh, const Hit& at) {
  const Triangle& corners = mesh.triangles[at.triangle];
  const auto is_direction = [](glm::dvec3 v, double least) {
    const double length = glm::length(v);
    return std::isfinite(length) && length > least;
  };
  if (!mesh.patch_normals.empty()) {
    const glm::dvec3 fine = patch_map_normal(mesh, at);
    if (is_direction(fine, 1e-6)) return glm::vec3(glm::normalize(fine));
  }
  if (const MeshNormalMap* const map = mesh_normals_at(mesh, at)) {
    const glm::dvec3 perturbed = mesh_map_normal(mesh, *map, at);
    if (is_direction(perturbed, 1e-6)) return glm::vec3(perturbed);
  }
  const glm::dvec3 smooth = blend(mesh.normals, corners, at.weights);
  // Opposite normals cancel out; what is left of them below this is rounding.
  if (is_direction(smooth, 1e-6)) return glm::vec3(glm::normalize(smooth));
  const glm::dvec3 ab = mesh.positions[corners[1]] - mesh.positions[corners[0]];
  const glm::dvec3 ac = mesh.positions[corners[2]] - mesh.positions[corners[0]];
  const glm::dvec3 flat = glm::cross(ab, ac);
  return is_direction(flat, 0.0) ? glm::vec3(glm::normalize(flat)) : glm::vec3(0.0F, 0.0F, 1.0F);
}

glm::vec2 uv_at(const TriangleMesh& mesh, const Hit& at) {
  if (mesh.uvs.empty()) return glm::vec2(0.0F);
  const glm::vec2 uv(blend(mesh.uvs, mesh.triangles[at.triangle], at.weights));
  return std::isfinite(uv.x + uv.y) ? uv : glm::vec2(0.0F);
}

std::uint32_t patch_at(const TriangleMesh& mesh, const Hit& at) {
  return mesh.patches.empty() ? 0 : mesh.patches[mesh.triangles[at.triangle][0]];
}

double body_at(const std::vector<MeshBody>& bodies, const TriangleMesh& mesh, const Hit& at) {
  const std::uint32_t vertex = mesh.triangles[at.triangle][0];
  const auto next =
      std::upper_bound(bodies.begin(), bodies.end(), vertex,
                       [](std::uint32_t v, const MeshBody& body) { return v < body.first; });
  return std::prev(next)->diameter;
}

std::uint8_t material_at(const TriangleMesh& mesh, const Hit& at) {
  return mesh.materials.empty() ? 0 : mesh.materials[mesh.triangles[at.triangle][0]];
}

}  // namespace relief::raytrace
