// Ends patches where their neighbours begin, so that make_seams() can join them.
#pragma once

#include <span>
#include <vector>

#include "common/patch.h"
#include "preprocess/resample/creases.h"
#include "preprocess/resample/mls.h"
#include "preprocess/resample/patch_grid.h"
#include "preprocess/resample/support.h"

namespace relief {

/// Turns nodes into holes that belong to other regions: the points about a node vote, the nearest
/// most, those whose normals are not on the side of the node's not at all. Also nodes that overhang
/// the border of the scan's sheet or a crease, and all that are not NodeState::Own. The heights of
/// those that stay beside a crease become those of their side alone. `all`: a lookup of all
/// `points`; `creases` is null if the region has none; `surface`: parallel to `states`.
void drop_foreign_nodes(const PatchPoints& points, const PointGrid& all,
                        const RegionCreases* creases, const PatchGrid& grid,
                        std::vector<SurfacePoint>& surface, std::vector<NodeState>& states);

/// Turns samples at borders into holes where samples of two patches are nearer to each other than
/// 0.45 spacings, between which triangles would be slivers: of two, the one that its patch sees
/// more askew.
void thin_borders(std::span<Patch> patches);

}  // namespace relief
