// On which side of its line a partner clips (Figure 6).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/clip/pairs/disc_tree.h"
#include "renderer/clip/pairs/partners.h"

namespace relief {

/// Returns for each partner of a splat whether the edge to it is concave, so that it clips what it
/// does not see, Eq. (18); otherwise it clips what it sees, Eq. (19).
///
/// An edge is concave if the splat and its partner see each other's centres. Where they disagree,
/// the greater height decides: one of the centres is almost on the other's plane. Partners of one
/// surface decide together, each with its heights over its distance, because along a bent edge and
/// across a corner distant ones mislead.
[[nodiscard]] std::vector<std::uint8_t> concave_edges(const DiscTree& tree,
                                                      std::span<const Partner> partners);

}  // namespace relief
