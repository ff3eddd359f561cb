// The rival of [Wicke 2004]: a fragment is clipped by the two partners nearest to it.
#pragma once

#include <glm/vec3.hpp>
#include <span>

#include "renderer/clip/clip_partners.h"

namespace relief {

/// Whether a point of the splat's plane, as its offset from the centre (world), is clipped by the
/// two partners whose centres are nearest to it: by one of them, or by both, by Figure 5 of
/// [Ivo 2011] for the two. `planes` has the plane of each line's partner.
[[nodiscard]] bool wicke_clips(std::span<const ClipLine> lines,
                               std::span<const PartnerPlane> planes, glm::vec3 offset);

}  // namespace relief
