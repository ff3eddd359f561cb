// Figures as texts.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <string>

namespace relief {

/// Returns a count with narrow gaps between its thousands: "1 234 567".
[[nodiscard]] std::string count_text(std::uint64_t count);

/// Returns a size in the decimal unit that suits it: "950 bytes", "1.2 kB", "34 MB".
[[nodiscard]] std::string size_text(std::uint64_t bytes);

/// Returns the sides of a box, four digits each, without a unit: "0.2051 x 0.145 x 0.0917" with
/// signs for "times".
[[nodiscard]] std::string extent_text(glm::dvec3 sides);

/// Returns a position in a box with these sides, to about a ten-thousandth of the largest of them.
[[nodiscard]] std::string position_text(glm::dvec3 position, glm::dvec3 sides);

}  // namespace relief
