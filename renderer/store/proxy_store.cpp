#include "renderer/store/proxy_store.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/packing.hpp>
#include <glm/packing.hpp>
#include <utility>

#include "common/octahedral.h"
#include "renderer/store/patch_attributes.h"

namespace relief {
namespace {

/// Steps of a mesh's frame along the diameter of its sphere.
constexpr double kSteps = 65535.0;

/// Octahedral coordinates of 13 bits each, then how far the unit normals of a mean are spread: its
/// length is 1 less the square of that, which has 6 bits.
std::uint32_t pack_normal(glm::vec3 normal) {
  const float length = glm::length(normal);
  if (!(length > 0.0F)) return 0;
  const glm::uvec2 corner(
      glm::round((0.5F * octahedral_from_unit(normal / length) + 0.5F) * 8191.0F));
  const float spread = std::sqrt(std::max(1.0F - length, 0.0F));
  return corner.x | (corner.y << 13U) |
         (static_cast<std::uint32_t>(std::lround(spread * 63.0F)) << 26U);
}

shared::ProxyVertex pack(const ProxyVertex& vertex, const StoredProxyMesh& mesh) {
  const glm::uvec3 p(
      glm::clamp(glm::round((vertex.position - mesh.origin) / mesh.unit), 0.0, kSteps));
  return {p.x | (p.y << 16U), p.z | (glm::uint32{glm::packHalf1x16(vertex.colour.r)} << 16U),
          glm::packHalf2x16({vertex.colour.g, vertex.colour.b}), pack_normal(vertex.normal)};
}

shared::ProxySource source_of(const ProxyVertex& vertex) {
  const glm::uvec2 uv(vertex.uv);
  return {vertex.patch, uv.x | (uv.y << 16U)};
}

}  // namespace

Result<std::uint32_t> ProxyUpload::add(std::span<const Patch> patches,
                                       std::span<const JoinedPatches> joined, const Proxy& model) {
  const Sphere& sphere = model.sphere;
  StoredProxyMesh mesh{sphere.centre - sphere.radius, 2.0 * sphere.radius / kSteps, {}};
  for (const ProxyLevel& level : make_proxy_levels(patches, joined, model)) {
    mesh.levels.push_back({static_cast<std::uint32_t>(vertices_.size()),
                           static_cast<std::uint32_t>(indices_.size()),
                           static_cast<std::uint32_t>(3 * level.triangles.size())});
    for (const ProxyVertex& vertex : level.vertices) {
      vertices_.push_back(pack(vertex, mesh));
      sources_.push_back(source_of(vertex));
    }
    for (const Triangle& t : level.triangles) indices_.insert(indices_.end(), t.begin(), t.end());
  }
  if (vertices_.size() > most_vertices_) {
    return make_error(
        "models seen from afar have {} vertices, more than this OpenGL can draw ({}); draw the "
        "scene with pixels-per-sample 0",
        vertices_.size(), most_vertices_);
  }
  meshes_.push_back(std::move(mesh));
  return static_cast<std::uint32_t>(meshes_.size() - 1);
}

std::uint32_t ProxyUpload::add_instance(std::uint32_t patch) {
  patches_.push_back(patch);
  return static_cast<std::uint32_t>(patches_.size() - 1);
}

ProxyStore ProxyUpload::take(const Gl& gl, bool with_sources) {
  Buffer indices = make_buffer(gl, "proxy triangles", std::span<const std::uint32_t>(indices_));
  Buffer patches = make_buffer(gl, "proxy instances", std::span<const std::uint32_t>(patches_));
  VertexArray attributes =
      make_patch_attributes(gl, "models from afar", patches, sizeof(std::uint32_t), indices);
  ProxyStore store{std::move(meshes_),
                   make_table(gl, "proxy vertices", GL_RGBA32UI,
                              std::span<const shared::ProxyVertex>(vertices_)),
                   std::nullopt,
                   std::move(indices),
                   std::move(patches),
                   std::move(attributes)};
  if (with_sources)
    store.sources =
        make_table(gl, "proxy sources", GL_RG32UI, std::span<const shared::ProxySource>(sources_));
  return store;
}

}  // namespace relief
