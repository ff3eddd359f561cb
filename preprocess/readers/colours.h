// Colours as files have them, to 8-bit sRGB.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

namespace relief {

/// What a file's colour numbers are.
enum class ColourNumbers { Integer, Real };

/// What colours as read are multiplied by so that they are 0..255. Files do not say it, so the
/// largest value tells it: reals up to 1 are 0..1; anything up to 255 is 0..255; anything larger is
/// 0..65535.
[[nodiscard]] float find_colour_scale(const std::vector<glm::vec3>& as_read, ColourNumbers numbers);

/// Scales colours as read to 0..255. NaN becomes 0.
[[nodiscard]] std::vector<glm::u8vec3> to_colours(const std::vector<glm::vec3>& as_read,
                                                  float scale);

/// The same with the scale that they tell themselves.
[[nodiscard]] std::vector<glm::u8vec3> to_colours(const std::vector<glm::vec3>& as_read,
                                                  ColourNumbers numbers);

}  // namespace relief
