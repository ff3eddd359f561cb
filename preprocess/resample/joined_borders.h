// Ends patches where their neighbours begin, so that make_seams() can join them.
#pragma once

#include <span>
#include <vector>

#include "common/patch.h"
#include "preprocess/resample/mls.h"
#include "preprocess/resample/patch_grid.h"
#include "preprocess/resample/support.h"

namespace relief {

/// Turns nodes into holes that belong to other regions: the points about a node vote, the nearest
/// most, those whose normals are not on the side of the node's not at all. Also nodes that overhang
/// the border of the scan's sheet, and all that are NodeState::Margin. `all`: a lookup of all
/// `points`; `surface`: parallel to `states`.
///
/// Points from `of_others` on (Membership) are of other tiles. Nothing meets the patch there: they
/// vote with its own, and it keeps its margin over them.
void drop_foreign_nodes(const PatchPoints& points, std::uint32_t of_others, const PointGrid& all,
                        const std::vector<SurfacePoint>& surface, const PatchGrid& grid,
                        std::vector<NodeState>& states);

/// Turns samples at borders into holes where samples of two patches are nearer to each other than
/// 0.45 spacings, between which triangles would be slivers: of two, the one that its patch sees
/// more askew.
void thin_borders(std::span<Patch> patches);

}  // namespace relief
