// Turning a camera: orbit, look, roll.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "viewer/navigation/pose.h"

namespace relief {

/// Turntable: to the side about the model's up axis, up and down about the image's horizontal; the
/// image never turns upside down. Trackball: about the image's own axes.
enum class OrbitStyle : std::uint8_t { Turntable, Trackball };

/// The elevation, degrees, beyond which a turntable does not turn; but a camera that is there
/// already may stay.
inline constexpr double kMostElevation = 89.9;

/// Returns the pose turned about a point as if one turned the model with the cursor. `shift`: of
/// the cursor, pixels, y downward. `angle`: radians per pixel. `axis`: the model's up axis, of
/// length 1.
///
/// A turntable turns about `axis` for a shift to the side, and about the image's horizontal for one
/// up or down, as far as kMostElevation. So a camera that is level stays level. One that is not
/// keeps the angle of its horizontal and the horizon; one that is upside down stays so until it is
/// turned over a pole; one that looks along `axis` turns the image in its plane.
[[nodiscard]] Pose orbited(const Pose& pose, glm::dvec3 about, glm::dvec2 shift, double angle,
                           OrbitStyle style, glm::dvec3 axis);

/// Returns the angle about the image's middle that a cursor has gone from one position to another,
/// radians, clockwise as seen. 0 while either is close to the middle, where a pixel would be a
/// large angle.
[[nodiscard]] double angle_about_middle(glm::dvec2 from, glm::dvec2 to, glm::dvec2 size);

/// Returns the pose turned about its line of sight, so that the image turns clockwise. Radians.
[[nodiscard]] Pose rolled(const Pose& pose, double angle);

}  // namespace relief
