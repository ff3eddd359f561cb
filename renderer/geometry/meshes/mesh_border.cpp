#include "renderer/geometry/meshes/mesh_border.h"

#include <cmath>
#include <glm/ext/vector_int2_sized.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <utility>

#include "renderer/geometry/cells/patch_border.h"
#include "renderer/geometry/meshes/mesh_vertices.h"
#include "renderer/geometry/patch_normals.h"
#include "shaders/include/shared.h"

namespace relief {
namespace {

/// How far the last triangle is set back, one at the border of the patch, world units.
float set_back_of(const Patch& patch, const TriangleMesh& mesh) {
  const Triangle& t = mesh.triangles.back();
  const glm::dvec3 across = glm::cross(mesh.positions[t[1]] - mesh.positions[t[0]],
                                       mesh.positions[t[2]] - mesh.positions[t[0]]);
  const double steepness = glm::length(across) / std::abs(glm::dot(across, patch.axes[2]));
  return static_cast<float>(shared::kBorderSetBack * patch.spacing * steepness);
}

}  // namespace

void add_border(const Patch& patch, std::uint32_t id, bool coloured,
                const std::vector<std::uint32_t>& vertices, TriangleMesh& mesh) {
  const PatchBorder border(patch);
  const AttributeMap<glm::i16vec2> normals = normal_map_of(patch);
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> added;  // by sample and side
  const auto vertex_of = [&](const BorderCorner& corner) {
    const auto node = static_cast<std::uint32_t>(corner.node.y) * patch.width +
                      static_cast<std::uint32_t>(corner.node.x);
    const glm::i32vec2 step = corner.toward - corner.node;
    if (step == glm::i32vec2(0)) return vertices[node];
    const auto side = static_cast<std::uint32_t>(step.x + 2 * step.y + 2);
    const auto [found, is_new] = added.try_emplace({node, side}, 0);
    if (!is_new) return found->second;
    const glm::dvec3 at = border.position_of(corner);
    found->second =
        add_vertex_between(patch, id, normals, patch.origin + patch.axes * (patch.spacing * at),
                           glm::dvec2(at), coloured, mesh);
    return found->second;
  };
  mesh.set_backs.resize(mesh.triangles.size(), 0.0F);
  border.for_each_polygon([&](glm::i32vec2 /*cell*/, const BorderPolygon& polygon) {
    const auto corner = [&](std::uint32_t c) { return vertex_of(polygon.corners[c]); };
    for (std::uint32_t c = 2; c < polygon.count; ++c) {
      mesh.triangles.push_back({corner(0), corner(c - 1), corner(c)});
      mesh.set_backs.push_back(set_back_of(patch, mesh));
    }
  });
}

}  // namespace relief
