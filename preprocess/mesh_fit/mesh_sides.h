// The sides of a mesh, between its creases.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <map>
#include <span>
#include <vector>

#include "common/neighbours/neighbours.h"
#include "common/points.h"

namespace relief {

/// The side of triangles that no point is of: any patch may show them.
inline constexpr std::uint32_t kAnySide = UINT32_MAX;

/// Which side the triangles of a mesh are of, and the points that were spread over them.
struct MeshSides {
  std::vector<std::uint32_t> of_triangles;
  std::vector<std::uint32_t> of_points;
  std::map<std::uint32_t, double> widths;  ///< of each side, world units (widths_of_sides)
};

/// How wide sides are: twice their area over the length of their borders, which is the width of a
/// strip and the radius of a disc. `mesh`: welded; `sides`: of its triangles. A side without a
/// border has no entry.
[[nodiscard]] std::map<std::uint32_t, double> widths_of_sides(
    const Points& mesh, const std::vector<std::uint32_t>& sides);

/// Finds sides with too few points for neighbours, each of which has kSurfaceNeighbours of its own:
/// makes them kAnySide. Returns 1 for each of their points, which must be dropped.
[[nodiscard]] std::vector<std::uint8_t> take_small_sides(MeshSides& sides);

/// Finds the nearest kSurfaceNeighbours of each point on its own side, so that nothing that looks
/// at neighbours sees across a crease. `sides`: of the points; each has more points than that.
[[nodiscard]] NeighbourGraph find_neighbours_on_sides(const std::vector<glm::dvec3>& positions,
                                                      const std::vector<std::uint32_t>& sides);

/// The side of a region's points: they have neighbours on no other.
[[nodiscard]] std::uint32_t side_of(const MeshSides& sides, std::span<const std::uint32_t> points);

}  // namespace relief
