// Cameras that show a model whole and as large as it fits.
#pragma once

#include <glm/vec3.hpp>
#include <span>

#include "common/scene/camera.h"

namespace relief {

/// The share of an image's width or height, the one that is tighter, that a framed model takes.
inline constexpr double kFramedShare = 0.9;

/// Returns a camera that looks in the direction of `camera`, with its up direction and field of
/// view or image height, from where the points (world units; not empty) take kFramedShare of an
/// image of `aspect` = width / height, in its middle. Only the eye and the target differ, and
/// orthographic the height if `fits_height`; the target is at the depth of the points' middle. All
/// points are before the eye.
[[nodiscard]] Camera framed(const Camera& camera, std::span<const glm::dvec3> points, double aspect,
                            bool fits_height);

/// Returns how far from `camera.target` the eye must be for the same without moving the target, so
/// that cameras all about it can share the largest distance. Perspective only.
[[nodiscard]] double framing_distance(const Camera& camera, std::span<const glm::dvec3> points,
                                      double aspect);

/// Returns the height of an orthographic image about the line of sight of `camera` that shows the
/// points whole.
[[nodiscard]] double framing_height(const Camera& camera, std::span<const glm::dvec3> points,
                                    double aspect);

}  // namespace relief
