// Sizes of surfels from their nearest neighbours.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "common/error.h"
#include "common/progress.h"
#include "renderer/surfels/settings.h"
#include "renderer/surfels/surfel_triangle.h"

namespace relief {

/// The diameter that a triangle gives its points; BspEdge or BspCircle.
[[nodiscard]] double diameter_of(const SurfelTriangle& triangle, SurfelSize method);

/// Gives the points of `leftovers` (indices) their diameters: that of the triangle of a point and
/// two of its 16 nearest neighbours that are not collinear with it, those whose farther one is
/// nearest. Where there are none, as on a line, the mean distance of its two nearest, or for
/// BspCircle the larger. 1 for a point that is alone.
///
/// Positions are finite and distinct; `diameters` is as long. Fails only if it is interrupted.
Status give_leftover_sizes(const std::vector<glm::dvec3>& positions,
                           std::span<const std::uint32_t> leftovers, SurfelSize method,
                           std::vector<double>& diameters, Progress& progress);

/// Finds the diameters that the leaves of QSplat's hierarchy have [Rusinkiewicz 2000]: spheres of
/// vertices that an edge of the mesh connects touch. Without a mesh, edges lead from each point to
/// its six nearest, as many as a vertex has on average, and to those that have it among theirs.
/// A sphere's radius is half the longest edge. Positions are finite and distinct.
/// Fails only if it is interrupted.
Result<std::vector<double>> find_qsplat_sizes(const std::vector<glm::dvec3>& positions,
                                              Progress& progress);

}  // namespace relief
