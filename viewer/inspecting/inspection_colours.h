// The colours of inspections.
#pragma once

#include <glm/ext/vector_uint3_sized.hpp>
#include <vector>

#include "common/scalars/colour_map.h"
#include "viewer/inspecting/inspection.h"

namespace relief {

/// The scale of overdraw ends at so many fragments a pixel; higher counts have its last colour.
inline constexpr double kMostFragments = 8.0;
/// The scale of the difference to the ray-traced truth ends at so many steps of 8-bit sRGB; larger
/// differences have its last colour.
inline constexpr double kMostDifference = 30.0;

inline constexpr ColourMap kFragmentMap = ColourMap::Inferno;
inline constexpr ColourMap kDifferenceMap = ColourMap::Magma;

/// Returns the colour of a patch, 8-bit sRGB: far from those of the ids near it. 256 colours; then
/// they repeat.
[[nodiscard]] glm::u8vec3 patch_colour(std::uint32_t id);

/// Returns the colour of a level, 0 the finest: light to dark.
[[nodiscard]] glm::u8vec3 level_colour(std::uint32_t level);

/// The colour of what is drawn from afar, and has no level.
inline constexpr glm::u8vec3 kAfarColour{150, 150, 150};

/// Returns the kInspectionColours colours that shaders/viewer/inspect.frag reads, 8-bit sRGB.
[[nodiscard]] std::vector<glm::u8vec3> colours_of(Inspection inspection);

}  // namespace relief
