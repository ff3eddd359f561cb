// Creases between border vertices of different patches.
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "common/seams/border_mesh.h"

namespace relief {

/// Whether a vertex is on a plane, or on a face that bends along its border only, as a bore does.
/// All of these need BorderVertex::plane_normal.
[[nodiscard]] bool is_plane(const BorderVertex& v);

/// Whether the surface has a crease between two vertices where planes through them meet: a turn
/// that is not that of a round feature.
[[nodiscard]] bool meet_at_crease(const BorderVertex& a, const BorderVertex& b);

/// Vertices whose normals' cosine is not below this are not at a right or acute edge.
inline constexpr double kRightEdge = 0.2;

/// The direction in which all faces at an edge of 100 degrees or less, or at a corner of such
/// edges, can be seen: the unit sum of their normals, world. Nothing if three vertices are at none.
[[nodiscard]] std::optional<glm::dvec3> outward_at_edge(const BorderVertex& a,
                                                        const BorderVertex& b,
                                                        const BorderVertex& c);

}  // namespace relief
