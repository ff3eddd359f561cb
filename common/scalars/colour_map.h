// Colours for numbers and for labels.
#pragma once

#include <array>
#include <cstdint>
#include <glm/ext/vector_uint3_sized.hpp>
#include <string_view>

#include "common/scene/choices.h"

namespace relief {

/// Perceptually uniform maps, but for Turbo, which has more colours and more contrast. Grey is the
/// ramp of sRGB values.
enum class ColourMap : std::uint8_t {
  Viridis,
  Cividis,
  Inferno,
  Magma,
  Plasma,
  Turbo,
  Batlow,
  Grey
};

inline constexpr std::array<Named<ColourMap>, 8> kColourMaps{{{"viridis", ColourMap::Viridis},
                                                              {"cividis", ColourMap::Cividis},
                                                              {"inferno", ColourMap::Inferno},
                                                              {"magma", ColourMap::Magma},
                                                              {"plasma", ColourMap::Plasma},
                                                              {"turbo", ColourMap::Turbo},
                                                              {"batlow", ColourMap::Batlow},
                                                              {"grey", ColourMap::Grey}}};

/// Returns the colour at `fraction`, clamped to 0 to 1; 8-bit sRGB.
[[nodiscard]] glm::u8vec3 colour_at(ColourMap map, double fraction);

/// Returns the colour of a label; 8-bit sRGB. It depends on nothing else, so that a class has the
/// same colour in all images. 20 colours; then they repeat.
[[nodiscard]] glm::u8vec3 label_colour(std::uint32_t label);

/// Returns the colour of a value of `classification`: brown ground, green vegetation, red
/// buildings, blue water. Values without a meaning have label_colour().
[[nodiscard]] glm::u8vec3 las_class_colour(std::uint32_t value);

/// The colour of what has no value.
inline constexpr glm::u8vec3 kNoScalarColour{128, 128, 128};

}  // namespace relief
