// How a model stands, and from where it is first looked at.
#pragma once

#include <glm/vec3.hpp>
#include <optional>

namespace relief {

/// The directions that cameras on an orbit refer to. World frame, unit vectors, at right angles.
struct Stance {
  glm::dvec3 up{0.0, 1.0, 0.0};
  glm::dvec3 front{0.0, 0.0, 1.0};  ///< from the model toward someone who stands before it
  /// All is seen from one sensor, which stands in front: from elsewhere, what it did not see is
  /// missing.
  bool is_from_sensor = false;

  bool operator==(const Stance&) const = default;
};

/// X to the east, Y to the north, Z up: surveys, maps, rasters. In front is the south.
inline constexpr Stance kZUp{{0.0, 0.0, 1.0}, {0.0, -1.0, 0.0}, false};

/// Up to this share of its width and depth a model's height makes it flat: the terrain and the
/// airborne scans at hand have 0.05 to 0.25, the flattest body, a rocker arm that lies, 0.59.
inline constexpr double kFlatHeight = 0.3;

/// Returns the stance whose up direction is `up`, of any length but 0. In front is what the nearest
/// of the six axes gives: with Y up +Z, with Z up -Y, with -Y up -Z, with -Z up +Y, with X and -X
/// up +Z.
[[nodiscard]] Stance stance_of(glm::dvec3 up);

/// Returns the stance that is asked for by its up direction, or the usual one.
[[nodiscard]] inline Stance stance_of(const std::optional<glm::dvec3>& up, const Stance& usual) {
  return up ? stance_of(*up) : usual;
}

}  // namespace relief
