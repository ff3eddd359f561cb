// Converts the colours of files to 8-bit sRGB.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

namespace relief {

/// The type of a file's colour numbers.
enum class ColourNumbers { Integer, Real };

/// Returns the factor that scales colours to 0..255. Files do not state their range, so it follows
/// from the largest value: reals up to 1 mean 0..1, other values up to 255 mean 0..255, larger ones
/// 0..65535.
[[nodiscard]] float find_colour_scale(const std::vector<glm::vec3>& as_read, ColourNumbers numbers);

/// Scales colours to 0..255. NaN becomes 0.
[[nodiscard]] std::vector<glm::u8vec3> to_colours(const std::vector<glm::vec3>& as_read,
                                                  float scale);

/// Scales colours to 0..255 by the factor that follows from their largest value.
[[nodiscard]] std::vector<glm::u8vec3> to_colours(const std::vector<glm::vec3>& as_read,
                                                  ColourNumbers numbers);

}  // namespace relief
