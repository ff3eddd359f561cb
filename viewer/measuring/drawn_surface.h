// The triangles that a patch is drawn as, near a point of it.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "common/patch.h"
#include "common/seams/seams.h"

namespace relief {

/// A triangle in the grid frame of a patch: column, row and height in cells, from node (0, 0).
using GridTriangle = std::array<glm::dvec3, 3>;

/// Columns and rows of nodes, both ends included.
struct NodeRange {
  glm::uvec2 first{0};
  glm::uvec2 last{0};
};

/// A world position in the grid frame of a patch; a direction or difference likewise.
[[nodiscard]] glm::dvec3 grid_position(const Patch& patch, glm::dvec3 world);
[[nodiscard]] glm::dvec3 grid_direction(const Patch& patch, glm::dvec3 world);

/// The world position of one in the grid frame.
[[nodiscard]] glm::dvec3 world_position(const Patch& patch, glm::dvec3 grid);

/// The nodes at most `reach` cells from a position, as many as the patch has; nothing between them
/// if it has none. `reach` is finite and not below 0.
[[nodiscard]] std::optional<NodeRange> nodes_about(const Patch& patch, glm::dvec3 grid,
                                                   double reach);

/// Returns a patch of some of the nodes of another, without colours and scalars. Its node (0, 0) is
/// `range.first`; heights, steps and axes stay.
[[nodiscard]] Patch window_of(const Patch& patch, const NodeRange& range);

/// What engine `onepass` draws with cells (renderer/geometry/cells/cells.h). Where there is a cell
/// or a seam it hides the splats, whose depths are set back.
struct DrawnTriangles {
  std::vector<GridTriangle> cells;
  std::vector<GridTriangle> splats;
};

/// Adds the cells between the nodes of `range`, and the splats of these nodes. `joined`: the patch
/// meets others, and has whole cells and no splats. `pixel`: how many cells a pixel is, which
/// splats have margins of.
void add_cells(const Patch& patch, const NodeRange& range, bool joined, double pixel,
               DrawnTriangles& drawn);

/// Adds those triangles of the patch's share of its run's seams that reach into the cube of
/// `reach` cells about a position. `share`: its number in the run.
void add_seams(const Patch& patch, const Seams& seams, std::uint32_t share, glm::dvec3 about,
               double reach, DrawnTriangles& drawn);

}  // namespace relief
