// The rival of [Wicke 2004]: a fragment is clipped by the two partners nearest to it.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <span>

#include "renderer/clip/clip_partners.h"

namespace relief {

/// The two partners whose centres are nearest to a point of the splat's plane, and whether the
/// areas that they clip are intersected, by Figure 5 of [Ivo 2011] for the two.
struct WickePair {
  std::size_t first = 0;   ///< place in the list of partners
  std::size_t second = 0;  ///< `first` if there is but one
  bool intersects = false;
};

/// Finds them; `planes` is not empty, `offset` from the splat's centre (world).
[[nodiscard]] WickePair wicke_pair(std::span<const PartnerPlane> planes, glm::vec3 offset);

/// Whether a point of the splat's plane, as its offset from the centre (world), is clipped by the
/// two partners whose centres are nearest to it: by one of them, or by both, by Figure 5 of
/// [Ivo 2011] for the two. `planes` has the plane of each line's partner.
[[nodiscard]] bool wicke_clips(std::span<const ClipLine> lines,
                               std::span<const PartnerPlane> planes, glm::vec3 offset);

}  // namespace relief
