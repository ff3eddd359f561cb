// Colour and normal maps of patches from the materials of the mesh that they were made of.
#pragma once

#include <cstdint>
#include <vector>

#include "common/error.h"
#include "common/patch.h"
#include "common/points.h"
#include "common/progress.h"

namespace relief {

/// Gives every patch a colour map with a resolution of its own. A texel shows what lies above or
/// below its place along the patch's normal: of the mesh's triangles the one nearest to the patch's
/// own surface, at most three cells away, rather one that faces the patch's side; there the mean
/// of the texture over the texel (MeshTexture::mean). Texels over holes, and those that meet no
/// triangle, continue their surroundings; triangles without a material are neutral grey. Where
/// materials have normal maps the patches' normals become maps with resolutions of their own, too
/// (NormalMapper); without them they stay as they are.
///
/// `texels_per_cell` along each side: 1 to kMostTexelsPerCell, or 0: of each patch the power of two
/// that keeps its texture's texels, of all together not more than 64 Mi texels (192 MiB of colours,
/// 256 of normals; coarser everywhere then). Fails, with a clause, if as many as asked for are more
/// than a patch or memory can hold, or if the user interrupts. Does not depend on the number of
/// threads.
Status map_textures(const Points& mesh, std::uint32_t texels_per_cell, std::vector<Patch>& patches,
                    Progress& progress);

/// What can be asked for; finer textures than that have more detail than a picture of all of a
/// patch shows.
inline constexpr std::uint32_t kMostTexelsPerCell = 64;

}  // namespace relief
