// A patch as cells: its heights without the holes around them, the runs of cells that have all four
// samples, what holes leave of others, and the splats for what those do not reach.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/ext/vector_uint2_sized.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "common/patch.h"
#include "renderer/geometry/cells/facing.h"
#include "shaders/include/shared.h"

namespace relief {

/// Where the heights of a row of nodes are kept: from its first sample to its last, holes between
/// them as shared::kHoleTexel.
struct CellRow {
  std::uint32_t base = 0;  ///< height of node i: heights[base + i], modulo 2^32
  std::uint32_t span = 0;  ///< first node; in the upper half the one after the last
};

/// The splat of a sample beside a jump to another sheet, or of one whose plane is off the cells by
/// more than shared::kCrease: as in SampleRecord but that its node is counted in the part, its
/// height is found by that, and the margins that close its gaps are in its reaches. It does not
/// reach toward holes, where border cells are, but beside a jump.
struct RimRecord {
  std::uint32_t node = 0;  ///< column, row, slopes: a byte each
  std::uint32_t reach = 0;
};

/// What a patch covers of a cell with samples and holes at its corners, as shaders/include/shared.h
/// says.
struct BorderCell {
  std::uint32_t cell = 0;
  std::uint32_t ways = 0;
};

/// A square of a patch, at most shared::kPartCells a side, that is culled and drawn as one.
struct CellPart {
  glm::uvec2 corner{0};                  ///< its first node
  std::vector<std::uint32_t> runs;       ///< packed as shaders/include/shared.h says, row by row
  std::vector<std::uint32_t> edge_runs;  ///< of a coarser level: cells with a hole at a corner
  std::vector<std::uint16_t> strip;      ///< instead of runs: nodes of a triangle strip, packed
  std::vector<BorderCell> borders;       ///< row by row
  std::vector<RimRecord> rims;           ///< row by row
  glm::dvec3 centre{0.0};  ///< of a sphere about its cells and splats, grid frame (cells)
  double radius = 0.0;     ///< of that sphere, cells
  NormalBounds normals;    ///< of its cells; empty if it has splats, which lean as they like
};

/// A patch as cells: about two bytes a sample of heights, and less than half as much of all else
/// where patches are smooth and large.
struct PatchCells {
  std::vector<std::uint16_t> heights;  ///< height indices, spans row by row
  std::vector<CellRow> rows;           ///< of each row of nodes and one without any beyond the last
  std::vector<CellPart> parts;         ///< those that draw something
};

/// Parts of a patch each way.
[[nodiscard]] inline glm::uvec2 part_counts(const Patch& patch) {
  return (glm::uvec2(patch.width, patch.height) + (shared::kPartCells - 1)) / shared::kPartCells;
}

/// The part that a node lies in, among those of a patch that are all there.
[[nodiscard]] inline std::size_t part_at(const Patch& patch, glm::uvec2 node) {
  const glm::uvec2 part = node / shared::kPartCells;
  return std::size_t{part.y} * part_counts(patch).x + part.x;
}

}  // namespace relief
