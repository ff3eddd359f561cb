// Clips one splat by its partners.
#pragma once

#include <span>
#include <vector>

#include "renderer/clip/clip_partners.h"
#include "renderer/clip/pairs/disc_tree.h"
#include "renderer/clip/pairs/partners.h"

namespace relief {

/// How a splat is clipped.
struct ClippedSplat {
  std::vector<ClipLine> lines;
  std::vector<PartnerPlane> planes;  ///< of each line; only for ClipRule::Wicke
  ClipKind kind = ClipKind::None;    ///< the same for every rule
  std::size_t disagreements = 0;     ///< as in ClipCounts
};

/// Clips a splat by its partners, nearest first, under a rule. `noise` is that of its normals,
/// radians.
[[nodiscard]] ClippedSplat clip_splat(const SplatDiscs& discs, const DiscTree& tree,
                                      const Disc& splat, std::span<const Partner> partners,
                                      ClipRule rule, double noise);

}  // namespace relief
