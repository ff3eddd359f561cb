// What images show of the maps of patches: a distant one no fine texels.
#pragma once

#include <cstdint>
#include <span>

#include "common/patch.h"
#include "renderer/view/patches_in_view.h"

namespace relief {

/// The texels of a map are seen at most this far apart where it is halved, in pixels: with 16
/// samples a pixel there is a texel for each.
inline constexpr double kPixelsPerTexel = 0.25;

/// Halves the texels a cell of colour and normal maps, patch by patch, as often as all onlookers
/// see what is left at most kPixelsPerTexel apart, and down to one a cell. Means are those of
/// linear light and of unit normals. Leaves the colours of labels as they are: none lies between
/// two. Returns how many bytes of texels it has dropped.
std::uint64_t drop_unseen_texels(std::span<const Onlooker> onlookers, std::span<Patch> patches,
                                 bool are_labels);

/// Halves the texels a cell of a map, an even number, once.
[[nodiscard]] AttributeMap<glm::u8vec3> halved(const AttributeMap<glm::u8vec3>& colours);
[[nodiscard]] AttributeMap<glm::i16vec2> halved(const AttributeMap<glm::i16vec2>& normals);

}  // namespace relief
