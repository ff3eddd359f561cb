// Whether the areas that the partners of a splat clip are united or intersected.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/clip/clip_partners.h"
#include "renderer/clip/disc_tree.h"
#include "renderer/clip/partners.h"

namespace relief {

/// Partners in groups, by their place in the list: a group's areas are intersected, the groups'
/// united.
struct PartnerSets {
  std::vector<std::vector<std::uint32_t>> groups;
  ClipKind kind = ClipKind::None;
};

/// Groups the partners of a splat by Figure 5 of [Ivo 2011].
[[nodiscard]] PartnerSets group_partners(const DiscTree& tree, const Disc& splat,
                                         std::span<const Partner> partners);

}  // namespace relief
