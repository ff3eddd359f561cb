#include "renderer/append.h"

#include <cstddef>
#include <limits>

#include "common/bounds.h"
#include "shaders/include/shared.h"

namespace relief {
namespace {

const glm::vec4 kGrey(glm::vec3(shared::kNeutralGrey), 1.0F);

/// How many elements two things have that are put together.
struct Counts {
  std::size_t to = 0;
  std::size_t from = 0;
};

/// Appends an attribute that either may lack; what one lacks is `missing`.
template <class T>
void append_attribute(std::vector<T>& to, const std::vector<T>& from, Counts counts,
                      const T& missing) {
  if (to.empty() && from.empty()) return;
  to.resize(counts.to, missing);
  to.insert(to.end(), from.begin(), from.end());
  to.resize(counts.to + counts.from, missing);
}

void count_on(std::vector<std::uint32_t>& patches, std::uint32_t before) {
  for (std::uint32_t& patch : patches) {
    if (patch != 0) patch += before;
  }
}

template <class Model>
void turn(Model& model, const Transform& transform) {
  for (glm::dvec3& p : model.positions) p = moved(transform, p);
  for (glm::vec3& n : model.normals) n = glm::vec3(transform.rotation * glm::dvec3(n));
}

/// Everything but what one of the kinds has alone.
template <class Model>
void append_shared(Model& to, Model& from, std::uint32_t patches_before) {
  const Counts counts{to.positions.size(), from.positions.size()};
  count_on(from.patches, patches_before);
  to.positions.insert(to.positions.end(), from.positions.begin(), from.positions.end());
  to.normals.insert(to.normals.end(), from.normals.begin(), from.normals.end());
  append_attribute(to.colours, from.colours, counts, kGrey);
  append_attribute(to.uvs, from.uvs, counts, glm::vec2(0.0F));
  append_attribute(to.patches, from.patches, counts, std::uint32_t{0});
  append_attribute(to.materials, from.materials, counts, std::uint8_t{0});
}

}  // namespace

void transform(TriangleMesh& mesh, const Transform& transform) {
  turn(mesh, transform);
  const glm::mat3 rotation(transform.rotation);
  for (CornerTangents& corners : mesh.tangents) {
    for (glm::vec4& tangent : corners) tangent = {rotation * glm::vec3(tangent), tangent.w};
  }
  for (PatchNormalMap& map : mesh.patch_normals) map.axes = rotation * map.axes;
  for (MeshBody& body : mesh.bodies) body.diameter *= transform.scale;
  for (float& set_back : mesh.set_backs) set_back *= static_cast<float>(transform.scale);
}

void transform(SplatCloud& cloud, const Transform& transform) {
  turn(cloud, transform);
  for (double& radius : cloud.radii) radius *= transform.scale;
}

std::vector<MeshBody> bodies_of(const TriangleMesh& mesh) {
  if (!mesh.bodies.empty() || mesh.positions.empty()) return mesh.bodies;
  return {{0, 2.0 * bounding_radius(mesh.positions, bounds_of(mesh.positions))}};
}

Status append(TriangleMesh& to, TriangleMesh from, std::uint32_t patches_before) {
  const std::size_t before = to.positions.size();
  if (before + from.positions.size() > std::numeric_limits<std::uint32_t>::max())
    return Error{"the scene's meshes have more vertices together than 32 bits count"};
  const auto offset = static_cast<std::uint32_t>(before);
  if (before > 0) {
    to.bodies = bodies_of(to);
    for (const MeshBody& body : bodies_of(from))
      to.bodies.push_back({body.first + offset, body.diameter});
  }
  append_shared(to, from, patches_before);
  const Counts triangles{to.triangles.size(), from.triangles.size()};
  for (std::uint32_t& texture : from.triangle_textures) {
    if (texture != kNoMaterial) texture += static_cast<std::uint32_t>(to.textures.size());
  }
  append_attribute(to.texcoords, from.texcoords, triangles, CornerTexcoords{});
  append_attribute(to.triangle_textures, from.triangle_textures, triangles, kNoMaterial);
  append_attribute(to.tangents, from.tangents, triangles, CornerTangents{});
  append_attribute(to.set_backs, from.set_backs, triangles, 0.0F);
  if (!from.patch_normals.empty()) to.patch_normals.resize(patches_before);
  to.patch_normals.insert(to.patch_normals.end(), from.patch_normals.begin(),
                          from.patch_normals.end());
  to.textures.insert(to.textures.end(), from.textures.begin(), from.textures.end());
  to.triangles.reserve(to.triangles.size() + from.triangles.size());
  for (const Triangle& t : from.triangles)
    to.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
  return {};
}

// Splats have one texture: the first. Those of another have the colours that it has at them.
void append(SplatCloud& to, SplatCloud from, std::uint32_t patches_before) {
  const Counts counts{to.positions.size(), from.positions.size()};
  if (to.texture == nullptr) to.texture = from.texture;
  if (to.texture != from.texture) from.texcoords.clear();
  append_attribute(to.texcoords, from.texcoords, counts,
                   glm::vec2(std::numeric_limits<float>::quiet_NaN()));
  append_shared(to, from, patches_before);
  to.radii.insert(to.radii.end(), from.radii.begin(), from.radii.end());
}

}  // namespace relief
