// Moving a camera without turning it: pan, zoom, fly; and other lenses.
#pragma once

#include <cmath>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "viewer/navigation/limits.h"
#include "viewer/navigation/pose.h"

namespace relief {

/// What a step of the wheel divides the distance by.
inline constexpr double kZoomStep = 1.2;

/// Returns the steps of a zoom that enlarges by `scale`, above 0: what a pinch reports.
[[nodiscard]] inline double zoom_steps(double scale) {
  return std::log(scale) / std::log(kZoomStep);
}

/// Returns the pose moved across the view so that what is at `depth` moves by `shift` (pixels, y
/// downward) in an image of `height` pixels.
[[nodiscard]] Pose panned(const Pose& pose, glm::dvec2 shift, double depth, double height);

/// Returns the pose nearer to a point before the eye, which stays at its pixel, by steps of
/// kZoomStep; within the limits.
[[nodiscard]] Pose zoomed(const Pose& pose, double steps, glm::dvec3 point, const Limits& limits);

/// Where a camera flies.
struct Flight {
  glm::dvec3 direction{0.0};  ///< right, up, forward: distances ahead a second
  double seconds = 0.0;
  double distance = 0.0;          ///< ahead, world units; an orthographic camera has its own
  std::optional<double> surface;  ///< depth of what it must not reach
  glm::dvec3 up{0.0, 1.0, 0.0};   ///< world, of length 1
};

/// Returns the pose after a flight within the limits. The distance to what is ahead shrinks
/// exponentially, independently of the frame rate.
[[nodiscard]] Pose flown(const Pose& pose, const Flight& flight, const Limits& limits);

/// Returns the pose with the other projection. What is at `depth`, above 0, stays where it is in
/// the image. A perspective eye is where the image's height shows as much of the world; an
/// orthographic one is set back until the model is before it.
[[nodiscard]] Pose with_projection(const Pose& pose, bool orthographic, double depth,
                                   const Limits& limits);

/// Returns the pose with another vertical field of view, likewise.
[[nodiscard]] Pose with_field_of_view(const Pose& pose, double degrees, double depth,
                                      const Limits& limits);

}  // namespace relief
