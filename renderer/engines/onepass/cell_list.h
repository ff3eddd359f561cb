// Which parts of patches a frame draws as cells, in which order.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/store/cell_store.h"
#include "renderer/view/draw_list.h"
#include "renderer/view/view.h"

namespace relief::onepass {

/// Which patches a pass draws.
struct MaterialChoice {
  std::vector<bool> drawn;  ///< by material; empty: all

  [[nodiscard]] bool has(std::uint8_t material) const { return drawn.empty() || drawn[material]; }
};

/// The parts in view of patches of those materials, of the levels that it chooses, nearest first.
[[nodiscard]] std::vector<std::uint32_t> find_parts(const PatchStore& store, const View& view,
                                                    const MaterialChoice& materials);

/// Leaves out the parts that show the view nothing but their back sides.
void leave_out_backs(const PatchStore& store, const View& view, std::vector<std::uint32_t>& parts);

/// Commands that draw the runs of parts, which are of one page.
[[nodiscard]] std::vector<ArraysCommand> run_commands(const CellStore& store,
                                                      const std::vector<std::uint32_t>& parts);

/// Commands that draw the cells of patches that meet others.
[[nodiscard]] std::vector<ElementsCommand> strip_commands(const CellStore& store,
                                                          const std::vector<std::uint32_t>& parts);

/// Commands that draw the cells of levels that holes touch, as strips.
[[nodiscard]] std::vector<ArraysCommand> edge_commands(const CellStore& store,
                                                       const std::vector<std::uint32_t>& parts);

/// Commands that draw their border cells.
[[nodiscard]] std::vector<ArraysCommand> border_commands(const CellStore& store,
                                                         const std::vector<std::uint32_t>& parts);

/// Commands that draw the splats beside their cells, at most kQuadsPerCommand each.
[[nodiscard]] std::vector<ElementsCommand> rim_commands(const CellStore& store,
                                                        const std::vector<std::uint32_t>& parts);

/// The seams in view of patches of those materials whose instances it shows from near, nearest
/// first, as indices of SeamStore::seams.
[[nodiscard]] std::vector<std::uint32_t> find_seams(const PatchStore& store, const View& view,
                                                    const MaterialChoice& materials);

/// Commands that draw seams, and the outermost cells of patches that the view shows at a coarser
/// level.
[[nodiscard]] std::vector<ElementsCommand> seam_commands(const PatchStore& store, const View& view,
                                                         const std::vector<std::uint32_t>& seams,
                                                         bool without_backs);

}  // namespace relief::onepass
