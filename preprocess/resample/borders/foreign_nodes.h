// Ends patches where their neighbours begin, so that make_seams() can join them.
#pragma once

#include <vector>

#include "preprocess/resample/borders/creases.h"
#include "preprocess/resample/heights/mls.h"
#include "preprocess/resample/support/patch_grid.h"
#include "preprocess/resample/support/support.h"

namespace relief {

/// The points about a patch, and what else tells whose they are.
struct PatchSurroundings {
  const PatchPoints& points;
  const PointGrid& all;                    ///< a lookup of all of them
  const RegionCreases* creases = nullptr;  ///< null if the region has none
  /// Points from here on (Membership) are of other tiles. Nothing meets the patch there: they vote
  /// with its own, and it keeps its margin over them.
  std::uint32_t of_others = 0;
  bool is_cut_later = false;  ///< by cut_to_mesh(): nodes may overhang the scan's border
};

/// Decides whose nodes are: those of NodeState::Own and Margin become Own, or holes if they belong
/// to other regions. The points about a node vote, the nearest most, those whose normals are not on
/// the side of the node's not at all. Nodes that overhang a crease or the border of the scan's
/// sheet become holes, too. Over other tiles the margin stays Margin. The heights of nodes that
/// stay beside a crease become those of their side alone. `surface`: parallel to `states`.
void drop_foreign_nodes(const PatchSurroundings& around, const PatchGrid& grid,
                        std::vector<MlsPoint>& surface, std::vector<NodeState>& states);

}  // namespace relief
