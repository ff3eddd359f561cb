// What lies along the borders of a patch's cells: cells that holes cut, and which samples have
// splats.
#pragma once

#include <cstdint>
#include <optional>

#include "renderer/geometry/cells/cell_nodes.h"
#include "renderer/geometry/cells/cell_parts.h"
#include "renderer/geometry/cells/patch_border.h"

namespace relief {

/// How far what leans as much (one over the cosine) is set back at a border, in steps of
/// shared::kSetBackStep.
[[nodiscard]] std::uint32_t set_back_steps(float steepness);

/// Adds the cells of a patch that have holes at their corners to its parts, all of which are there.
/// One whose lower left node is outside of the patch belongs to the part of the nearest node.
void add_border_cells(const Patch& patch, const PatchBorder& border, const CellNodes& nodes,
                      PatchCells& cells);

/// How far the splat of a sample of a patch that overlaps others reaches (CellNodes::closed_reach);
/// nothing if it has none. `border`: the patch's.
[[nodiscard]] std::optional<std::uint32_t> rim_reach(const CellNodes& nodes,
                                                     const PatchBorder& border,
                                                     const SampleRecord& record);

}  // namespace relief
