// Which parts of patches a frame draws as cells, in which order.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/cell_store.h"
#include "renderer/draw_list.h"
#include "renderer/view.h"

namespace relief::onepass {

/// The parts in view, of the levels that it chooses, nearest first.
[[nodiscard]] std::vector<std::uint32_t> find_parts(const PatchStore& store, const View& view);

/// Commands that draw the cells of one page's share of `parts`, as strips.
[[nodiscard]] std::vector<ArraysCommand> cell_commands(const CellStore& store,
                                                       const std::vector<std::uint32_t>& parts,
                                                       std::uint32_t page);

/// Commands that draw the cells of levels that holes touch, as strips.
[[nodiscard]] std::vector<ArraysCommand> edge_commands(const CellStore& store,
                                                       const std::vector<std::uint32_t>& parts,
                                                       std::uint32_t page);

/// Commands that draw their border splats, at most kQuadsPerCommand each.
[[nodiscard]] std::vector<ElementsCommand> rim_commands(const CellStore& store,
                                                        const std::vector<std::uint32_t>& parts,
                                                        std::uint32_t page);

}  // namespace relief::onepass
