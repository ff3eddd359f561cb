// A camera as its movements compute with it: without the rounding that large coordinates cause.
#pragma once

#include <glm/ext/quaternion_double.hpp>
#include <glm/vec3.hpp>

#include "common/scene/camera.h"

namespace relief {

/// A camera relative to an origin near the model. At UTM coordinates a position in the world is
/// rounded to 1e-9 units; what a movement adds up is not.
struct Pose {
  glm::dvec3 eye{0.0, 0.0, 1.0};  ///< from the origin, world directions
  glm::dquat turn{1.0, 0.0, 0.0,
                  0.0};  ///< from eye coordinates (x right, y up, z backward) to world
  double focus = 1.0;    ///< depth of the target, above 0
  double vertical_fov_degrees = 45.0;
  double orthographic_height = 0.0;  ///< as in Camera

  [[nodiscard]] bool is_orthographic() const { return orthographic_height > 0.0; }
  [[nodiscard]] glm::dvec3 right() const { return turn * glm::dvec3(1.0, 0.0, 0.0); }
  [[nodiscard]] glm::dvec3 up() const { return turn * glm::dvec3(0.0, 1.0, 0.0); }
  [[nodiscard]] glm::dvec3 backward() const { return turn * glm::dvec3(0.0, 0.0, 1.0); }
};

/// Returns the pose of a usable camera.
[[nodiscard]] Pose pose_of(const Camera& camera, glm::dvec3 origin);

/// Returns the camera of a pose. Its target is farther than `focus` where rounding would else turn
/// the line of sight. With origin 0 it is the camera relative to the pose's origin.
[[nodiscard]] Camera camera_of(const Pose& pose, glm::dvec3 origin);

/// Coordinates beyond this limit are no camera's: their squares would not be finite.
inline constexpr double kMostCoordinate = 1e100;

/// Returns whether the coordinates of a camera are up to kMostCoordinate and its eye, target and up
/// direction make a view.
[[nodiscard]] bool is_usable(const Camera& camera);

/// Returns the camera, with another up direction if its own runs along the line of sight. Its image
/// is the same.
[[nodiscard]] Camera with_usable_up(const Camera& camera);

/// Returns tan(fov / 2): half the image's height at depth 1.
[[nodiscard]] double slope_of(const Pose& pose);

/// Returns the depth of a point (from the origin).
[[nodiscard]] double depth_of(const Pose& pose, glm::dvec3 point);

/// Returns how much of the world the height of the image shows at a depth.
[[nodiscard]] double image_height_at(const Pose& pose, double depth);

/// Returns the pose turned about a point (from the origin). The point stays at its pixel.
[[nodiscard]] Pose turned(const Pose& pose, const glm::dquat& rotation, glm::dvec3 about);

}  // namespace relief
