// The classification of clip partners, in the order of [Ivo 2011].
#include <algorithm>
#include <utility>

#include "renderer/clip/clip_partners.h"
#include "renderer/clip/lines/clip_splat.h"
#include "renderer/clip/pairs/different_surface.h"
#include "renderer/clip/pairs/disc_tree.h"
#include "renderer/clip/pairs/partners.h"
#include "renderer/clip/pairs/refit_normals.h"
#include "renderer/clip/pairs/slot_pieces.h"

namespace relief {
namespace {

/// Discs that are looked at for a splat. Splats of one spacing have about 30 neighbours, one among
/// others a tenth as large 1500.
constexpr std::size_t kTested = 4096;
/// Partners of a splat, and of all splats (512 MB). A splat at a straight edge has about 10.
constexpr std::size_t kPartnersOfSplat = 256;
constexpr std::size_t kPartnersOfAll = std::size_t{1} << 27U;

PartnerLimits limits_for(std::size_t discs) {
  return {kTested, std::clamp(kPartnersOfAll / discs, std::size_t{16}, kPartnersOfSplat)};
}

/// Clips all discs of a tree; advances by one unit for each. Splats without a disc are empty.
std::vector<ClippedSplat> clip_splats(const SplatDiscs& discs, const DiscTree& tree,
                                      const SurfaceTest& test, const PartnerLists& lists,
                                      ClipRule rule, Progress& progress) {
  std::vector<ClippedSplat> clipped(discs.centres.size());
  for_pieces(tree.discs().size(), [&](std::size_t /*piece*/, std::size_t begin, std::size_t end) {
    std::vector<Partner> partners;
    for (std::size_t slot = begin; slot < end && !progress.cancelled(); ++slot) {
      if (lists.of(slot).empty()) continue;
      partners.clear();
      for (const std::uint32_t other : lists.of(slot))
        if (const auto partner = as_partner(discs, tree, test, slot, other))
          partners.push_back(*partner);
      const Disc& splat = tree.discs()[slot];
      clipped[splat.splat] = clip_splat(discs, tree, splat, partners, rule, test.noise(slot));
    }
    progress.advance(end - begin);
  });
  return clipped;
}

void append(ClipPartners& result, const ClippedSplat& clipped) {
  result.lines.insert(result.lines.end(), clipped.lines.begin(), clipped.lines.end());
  result.planes.insert(result.planes.end(), clipped.planes.begin(), clipped.planes.end());
  result.first.push_back(static_cast<std::uint32_t>(result.lines.size()));
  result.kinds.push_back(clipped.kind);
  ++result.counts.kinds[static_cast<std::size_t>(clipped.kind)];
  result.counts.disagreements += clipped.disagreements;
}

}  // namespace

Result<ClipPartners> find_clip_partners(const SplatDiscs& discs, const ClipSettings& settings,
                                        Progress& progress) {
  ClipPartners result;
  result.first.push_back(0);
  DiscTree tree(settings.rule == ClipRule::Off ? SplatDiscs{} : discs);
  std::vector<ClippedSplat> clipped(discs.centres.size());
  if (!tree.discs().empty()) {
    progress.begin_stage("clip partners", 2 * tree.discs().size());
    if (settings.normals == ClipNormals::Refit) {
      RELIEF_TRY_ASSIGN(const auto normals, refit_normals(tree, progress));
      tree.set_normals(normals);
    }
    const SurfaceTest test(tree, settings.threshold);
    RELIEF_TRY_ASSIGN(const PartnerLists lists,
                      find_partners(discs, tree, test, limits_for(tree.discs().size()), progress));
    clipped = clip_splats(discs, tree, test, lists, settings.rule, progress);
    if (progress.cancelled()) return interrupted_error();
    result.counts.neighbours = lists.neighbours;
    result.counts.partners = lists.slots.size();
    result.counts.cut = lists.cut;
    result.counts.threshold = test.threshold();
  }
  for (const ClippedSplat& splat : clipped) append(result, splat);
  return result;
}

}  // namespace relief
