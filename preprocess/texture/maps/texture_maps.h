// Makes the colour and normal maps of patches from the materials of their mesh.
#pragma once

#include <cstdint>
#include <vector>

#include "common/error.h"
#include "common/patch.h"
#include "common/points.h"
#include "common/progress.h"
#include "preprocess/texture/maps/map_scales.h"

namespace relief {

/// Gives every patch a colour map with its own resolution. A texel shows the triangle above or
/// below it along the patch's normal that is nearest to the patch's surface, at most three cells
/// away, preferably one that faces the patch's side. Its colour is the mean of the texture over the
/// texel (MeshTexture::mean). Texels over holes, and those without a triangle, continue their
/// surroundings. Triangles without a material are neutral grey. If materials have normal maps, the
/// patches' normals also become maps with their own resolution (NormalMapper).
///
/// `texels_per_cell` along each side: 1 to kMaxTexelsPerCell. 0: for each patch the power of two
/// that keeps its texture's resolution, with at most 64 Mi texels in all (192 MiB of colours, 256
/// of normals); all become coarser if necessary. Fails, with a clause, if the requested texels
/// exceed a patch's limit or memory, or if the user interrupts. The result does not depend on the
/// number of threads.
Status map_textures(const Points& mesh, std::uint32_t texels_per_cell, std::vector<Patch>& patches,
                    Progress& progress);

}  // namespace relief
