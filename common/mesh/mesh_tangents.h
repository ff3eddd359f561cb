// Tangent frames of meshes, to which normal maps are relative.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

#include "common/points.h"

namespace relief {

/// Returns whether some triangle's material has a normal map (see load_textures).
[[nodiscard]] bool has_normal_maps(const Points& mesh);

/// Returns the normal map of a triangle; null without one.
[[nodiscard]] const MeshNormalMap* triangle_normal_map(const Points& mesh, std::size_t triangle);

/// Returns the tangents of the corners of all triangles with a normal map: unit, orthogonal to the
/// vertex normal; w: 1, or -1 if the texture is mirrored. 0 for other triangles, and where the
/// texture coordinates span no area, so that the map is undefined.
///
/// Uses the file's tangents if it has them, otherwise those of MikkTSpace (Mikkelsen 2008,
/// "Simulation of Wrinkled Surfaces Revisited", chapter 5): the directions in which u grows over
/// the triangles that share the vertex, its texture coordinates and the handedness, each projected
/// into the plane of the vertex normal, weighted by the angle at the vertex. (MikkTSpace also
/// ignores triangles that no edge connects.) `normals`: unit, of all points (vertex_normals).
[[nodiscard]] std::vector<CornerTangents> tangents_of(const Points& mesh,
                                                      const std::vector<glm::vec3>& normals);

/// The tangent frame at a position of a triangle: interpolated linearly and not normalised, as
/// bakers do it.
struct TangentFrame {
  glm::dvec3 tangent{0.0};
  glm::dvec3 bitangent{0.0};
  glm::dvec3 normal{0.0};
};

/// `normals`: unit, of the corners; `weights`: barycentric. Without a tangent, the frame has only
/// the normal.
[[nodiscard]] TangentFrame frame_at(const CornerTangents& tangents,
                                    const std::array<glm::vec3, 3>& normals, glm::dvec3 weights);

/// Returns the unit normal of a normal map's vector in that frame, with its x and y multiplied by
/// `scale`. The frame's normal if the vector has no direction; 0 if neither has one.
[[nodiscard]] glm::dvec3 perturbed_normal(const TangentFrame& frame, glm::vec3 from_map,
                                          float scale);

}  // namespace relief
