// The vertices of patches in a mesh of them.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <vector>

#include "common/patch.h"
#include "renderer/geometry/meshes/triangle_mesh.h"

namespace relief {

/// The vertex of a node without a sample.
inline constexpr std::uint32_t kNoVertex = std::numeric_limits<std::uint32_t>::max();

/// Adds a patch's samples, as patch `id` + 1, and returns for each node which vertex it has become.
/// `coloured`: the mesh has colours; those of a patch without any are grey.
[[nodiscard]] std::vector<std::uint32_t> add_vertices(const Patch& patch, std::uint32_t id,
                                                      bool coloured, TriangleMesh& mesh);

/// Adds a vertex between a patch's samples, or beyond them. `position`: world; `uv`: its grid
/// coordinates, where the maps give the attributes. `normals`: the patch's normal_map_of().
std::uint32_t add_vertex_between(const Patch& patch, std::uint32_t id,
                                 const AttributeMap<glm::i16vec2>& normals, glm::dvec3 position,
                                 glm::dvec2 uv, bool coloured, TriangleMesh& mesh);

}  // namespace relief
