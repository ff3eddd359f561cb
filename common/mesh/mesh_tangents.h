// The frames that normal maps of meshes are relative to.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

#include "common/points.h"

namespace relief {

/// Whether some triangle's material has a normal map (load_textures).
[[nodiscard]] bool has_normal_maps(const Points& mesh);

/// The normal map of a triangle; null: none.
[[nodiscard]] const MeshNormalMap* triangle_normal_map(const Points& mesh, std::size_t triangle);

/// Tangents of the corners of all triangles with a normal map: unit, square to the vertex' normal;
/// w: 1, or -1 where the texture is mirrored. 0 for others, and where the texture coordinates span
/// no area: the map says nothing there.
///
/// Those that the file gives; else, as MikkTSpace has them (Mikkelsen 2008, "Simulation of Wrinkled
/// Surfaces Revisited", chapter 5): the directions in which u grows over the triangles that share
/// the vertex, its texture coordinates and the handedness, each laid into the plane of the vertex'
/// normal, weighted by the angle at the vertex. (MikkTSpace leaves out what no edge connects, too.)
/// `normals`: unit, of all points (vertex_normals).
[[nodiscard]] std::vector<CornerTangents> tangents_of(const Points& mesh,
                                                      const std::vector<glm::vec3>& normals);

/// The frame at a place of a triangle: linear over it and not made unit there, as the baker had it.
struct TangentFrame {
  glm::dvec3 tangent{0.0};
  glm::dvec3 bitangent{0.0};
  glm::dvec3 normal{0.0};
};

/// `normals`: unit, of the corners; `weights`: barycentric. Without a tangent it has the normal
/// alone.
[[nodiscard]] TangentFrame frame_at(const CornerTangents& tangents,
                                    const std::array<glm::vec3, 3>& normals, glm::dvec3 weights);

/// The unit normal that a normal map's vector stands for in that frame, with `scale` on its x and
/// y; the frame's own where that has no direction. 0 if the frame has none either.
[[nodiscard]] glm::dvec3 perturbed_normal(const TangentFrame& frame, glm::vec3 from_map,
                                          float scale);

}  // namespace relief
