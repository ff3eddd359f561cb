// How far a camera may go: what keeps it before the surface, near the model, and finite.
#pragma once

#include <glm/vec3.hpp>

#include "common/patch.h"
#include "viewer/navigation/pose.h"

namespace relief {

/// The image's height at the model's depth when one has zoomed out all the way, in radii of the
/// model.
inline constexpr double kFarthestRadii = 100.0;

/// What bounds a camera. World units, positions from the poses' origin.
struct Limits {
  glm::dvec3 centre{0.0};      ///< of the model
  double radius = 1.0;         ///< of its bounding sphere, above 0
  double least_height = 1e-6;  ///< of the world in the image's height, at the depth of the point
                               ///< that one zooms towards
};

/// Returns the limits for a model and an image of `aspect` = width / height. One sample fills the
/// image when one has zoomed in all the way; but pixels stay larger than the rounding of
/// coordinates, so that a close-up does not shake.
[[nodiscard]] Limits limits_for(const PatchModel& extent, glm::dvec3 origin, double aspect);

/// Returns how near the eye may come to a surface, along the line of sight.
[[nodiscard]] double least_depth(const Limits& limits, const Pose& pose);

/// Returns the share, 1 or more, by which the eye may at most move away from a point, in shares of
/// its distance to it.
[[nodiscard]] double farthest_factor(const Limits& limits, const Pose& pose, glm::dvec3 point);

/// Returns `pose` with its eye no farther from the model than zooming out leads, nor than
/// `before`'s.
[[nodiscard]] Pose within_reach(const Limits& limits, const Pose& before, const Pose& pose);

/// Returns the depth of the model's centre at which the model is just before the eye.
[[nodiscard]] double clear_depth(const Limits& limits);

/// Returns an orthographic pose with its eye so far back along the line of sight that the model's
/// centre is at `depth` at least, up to clear_depth(): what is behind the eye would not be seen.
/// Perspective poses stay as they are.
[[nodiscard]] Pose set_back(const Limits& limits, const Pose& pose, double depth);

/// Returns the same with the depth that the centre had in `before`: a camera that shows the model
/// whole never cuts it, and one that cuts it on purpose does not jump.
[[nodiscard]] Pose kept_before_model(const Limits& limits, const Pose& before, const Pose& pose);

}  // namespace relief
