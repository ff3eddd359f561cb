// Creases of meshes: edges at which the planes of two triangles turn by more than 40 degrees.
#pragma once

#include <cstdint>
#include <vector>

#include "common/points.h"

namespace relief {

/// Normals that turn by more than 40 degrees are those of two faces.
inline constexpr double kCreaseCosine = 0.766;

/// Returns the side of each triangle, a number: sides are connected by edges that are no creases.
/// A crease that ends within a surface parts no sides.
[[nodiscard]] std::vector<std::uint32_t> sides_of_triangles(const Points& mesh);

/// The creases of a mesh, and whether they are lines.
struct CreaseCensus {
  std::size_t edges = 0;  ///< of two triangles that have an area
  std::size_t creases = 0;
  std::size_t ends_in_lines = 0;  ///< of two a crease: those where it meets one other crease
};

/// Counts the creases of a mesh with valid indices, whichever way its triangles face. Positions
/// that are repeated part it.
[[nodiscard]] CreaseCensus count_creases(const Points& mesh);

/// Gives the points of a mesh normals, and those on creases one for each side, for which they are
/// repeated after all others. Normals are means of the triangles of a side, weighted by angle and
/// area, so that large plane faces stay plane beside rounded edges. 0 for points without a triangle
/// that has an area.
void split_at_creases(Points& mesh);

}  // namespace relief
