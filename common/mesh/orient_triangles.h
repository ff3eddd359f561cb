// Triangles that agree about which side of a mesh is out.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/points.h"

namespace relief {

/// Finds which triangles to turn so that neighbours at edges of two triangles agree: hand-made
/// meshes and those of some modellers mix both windings. `welded`: the mesh's triangles with one
/// point a position. Returns 1 for each triangle to turn. Pieces that agree already stay as they
/// are, and so do those that have one side only. Others face as their vertices' normals do; without
/// those a closed piece faces outward, and an open one as most of its area did.
[[nodiscard]] std::vector<std::uint8_t> triangles_to_turn(const Points& mesh,
                                                          std::span<const Triangle> welded);

/// Turns a triangle over, with what its corners have.
void turn_triangle(Points& mesh, std::size_t triangle);

/// Turns the triangles that triangles_to_turn() finds, in `welded`, too. Returns whether they agree
/// then, but for a few (kMaxMisoriented).
bool orient_triangles(Points& mesh, std::vector<Triangle>& welded);
/// The same of a mesh whose triangles are not welded yet.
bool orient_triangles(Points& mesh);

}  // namespace relief
