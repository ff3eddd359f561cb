// Points that are spread over a mesh, in place of its own.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/points.h"
#include "common/progress.h"

namespace relief {

struct SpreadPoints {
  Points points;                         ///< without triangles
  std::vector<std::uint32_t> triangles;  ///< on which each lies, of the mesh
};

/// Spreads about `count` points evenly over the triangles of a mesh, with interpolated attributes.
/// Its corners come first, then points of edges, then those within triangles; none is nearer to an
/// earlier one than three fifths of their distance, unless they lie on two sides of a thin wall. So
/// edges keep their points, and needles do not crowd them. The mesh must have normals. No points if
/// the triangles have no area. Incomplete if the user interrupts.
[[nodiscard]] SpreadPoints spread_on_mesh(const Points& mesh, std::size_t count,
                                          const Progress& progress = Progress());

}  // namespace relief
