// Smooth transitions from one camera to another.
#pragma once

#include "common/scene/camera.h"
#include "viewer/navigation/limits.h"
#include "viewer/navigation/pose.h"

namespace relief {

/// Seconds that a transition takes.
inline constexpr double kTransitionSeconds = 0.3;

/// A transition under way.
struct Transition {
  Pose from;
  Pose to;
  Camera end;            ///< what is shown when it is over
  double elapsed = 0.0;  ///< seconds
};

/// Returns the pose at a share, 0 to 1, of the way.
///
/// The target, what it shows of the world, and so the distance, follow the path of least visual
/// change of [van Wijk 2003]: on the spot the distance changes exponentially; between distant
/// close-ups the camera goes back, across and down again, and not through what lies between. It
/// turns about the target meanwhile, at constant speed and the short way (slerp). Between the
/// projections it is a perspective one whose field of view shrinks or grows. It never shows more of
/// the world than `most_height` in the image's height, unless an end does.
[[nodiscard]] Pose pose_between(const Pose& from, const Pose& to, double share, double most_height);

/// Returns the pose of a transition now, at a speed that grows and fades, with the model before an
/// orthographic eye if it is so at both ends.
[[nodiscard]] Pose pose_of(const Transition& transition, const Limits& limits);

}  // namespace relief
