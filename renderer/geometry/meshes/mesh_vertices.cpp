#include "renderer/geometry/meshes/mesh_vertices.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "common/image/srgb.h"
#include "common/octahedral.h"
#include "renderer/geometry/patch_normals.h"
#include "shaders/include/shared.h"

namespace relief {
namespace {

/// The colour of a map at the texel nearest to grid coordinates, linear.
glm::vec3 colour_at(const Patch& patch, glm::dvec2 uv) {
  const AttributeMap<glm::u8vec3>& map = patch.colours;
  if (map.empty()) return glm::vec3(shared::kNeutralGrey);
  const glm::dvec2 most(map.width - 1, map.height - 1);
  const glm::uvec2 texel(
      glm::clamp(glm::round(uv * static_cast<double>(map.scale)), glm::dvec2(0.0), most));
  return linear_from_srgb8(map.texels[std::size_t{texel.y} * map.width + texel.x]);
}

/// The normal of a map at grid coordinates, bilinear, in the patch frame.
glm::vec3 normal_at(const AttributeMap<glm::i16vec2>& map, glm::dvec2 uv) {
  const glm::dvec2 most(map.width - 1, map.height - 1);
  const glm::dvec2 texel = glm::clamp(uv * static_cast<double>(map.scale), glm::dvec2(0.0), most);
  const glm::dvec2 low = glm::min(glm::floor(texel), glm::max(most - 1.0, glm::dvec2(0.0)));
  const glm::vec2 part(texel - low);
  const auto at = [&](std::uint32_t i, std::uint32_t j) {
    const std::uint32_t x = std::min(static_cast<std::uint32_t>(low.x) + i, map.width - 1);
    const std::uint32_t y = std::min(static_cast<std::uint32_t>(low.y) + j, map.height - 1);
    return glm::vec2(map.texels[std::size_t{y} * map.width + x]) / 32767.0F;
  };
  return unit_from_octahedral(
      glm::mix(glm::mix(at(0, 0), at(1, 0), part.x), glm::mix(at(0, 1), at(1, 1), part.x), part.y));
}

}  // namespace

std::vector<std::uint32_t> add_vertices(const Patch& patch, std::uint32_t id, bool coloured,
                                        TriangleMesh& mesh) {
  std::vector<std::uint32_t> vertices(patch.heights.size(), kNoVertex);
  const AttributeMap<glm::i16vec2> normals = normal_map_of(patch);
  const glm::mat3 axes(patch.axes);
  for (std::uint32_t j = 0; j < patch.height; ++j) {
    for (std::uint32_t i = 0; i < patch.width; ++i) {
      if (patch.at(i, j) == kHole) continue;
      vertices[std::size_t{j} * patch.width + i] =
          static_cast<std::uint32_t>(mesh.positions.size());
      mesh.positions.push_back(position_of(patch, i, j));
      mesh.normals.push_back(glm::normalize(axes * normal_at_node(normals, i, j)));
      if (coloured) {
        const glm::vec3 colour = patch.colours.empty()
                                     ? glm::vec3(shared::kNeutralGrey)
                                     : linear_from_srgb8(texel_at(patch.colours, i, j));
        mesh.colours.emplace_back(colour, 1.0F);
      }
      mesh.uvs.emplace_back(i, j);
      mesh.patches.push_back(id + 1);
    }
  }
  return vertices;
}

std::uint32_t add_vertex_between(const Patch& patch, std::uint32_t id,
                                 const AttributeMap<glm::i16vec2>& normals, glm::dvec3 position,
                                 glm::dvec2 uv, bool coloured, TriangleMesh& mesh) {
  const auto vertex = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.push_back(position);
  mesh.normals.push_back(glm::normalize(glm::mat3(patch.axes) * normal_at(normals, uv)));
  if (coloured) mesh.colours.emplace_back(colour_at(patch, uv), 1.0F);
  mesh.uvs.emplace_back(uv);
  mesh.patches.push_back(id + 1);
  return vertex;
}

}  // namespace relief
