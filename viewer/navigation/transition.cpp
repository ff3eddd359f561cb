#include "viewer/navigation/transition.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>

namespace relief {
namespace {

/// Of [van Wijk 2003]: how far back the camera goes to cover a distance. The square root of 2, as
/// in D3.
constexpr double kRho = glm::root_two<double>();

/// Below this share of what is seen a change of place is none: the path's equations divide by it.
constexpr double kLeastWay = 1e-9;

/// Half the height at depth 1 of a perspective image that can't be told from an orthographic one.
constexpr double kNearlyParallel = 0.01;

/// What a camera shows: the share of the way that its target has gone, and the world in the image's
/// height there.
struct Shown {
  double way;
  double height;
};

/// The optimal path of [van Wijk 2003], rearranged so that nothing cancels.
Shown shown_between(double from, double to, double distance, double share) {
  if (distance < kLeastWay * std::max(from, to))
    return {share, from * std::exp(share * std::log(to / from))};
  const double far = kRho * kRho * distance;
  const double change = (to - from) * (to + from);
  const double r0 = -std::asinh((change + far * far) / (2.0 * from * far));
  const double r1 = -std::asinh((change - far * far) / (2.0 * to * far));
  const double s = share * (r1 - r0);
  return {from / far * std::sinh(s) / std::cosh(s + r0), from * std::cosh(r0) / std::cosh(s + r0)};
}

double slope_at_end(const Pose& pose, bool both_orthographic) {
  return pose.is_orthographic() && !both_orthographic ? kNearlyParallel : slope_of(pose);
}

glm::dvec3 target_of(const Pose& pose) {
  return pose.eye - pose.focus * pose.backward();
}

double smoothstep(double t) {
  return t * t * (3.0 - 2.0 * t);
}

}  // namespace

Pose pose_between(const Pose& from, const Pose& to, double share, double most_height) {
  const glm::dvec3 start = target_of(from);
  const glm::dvec3 way = target_of(to) - start;
  const double first = image_height_at(from, from.focus);
  const double last = image_height_at(to, to.focus);
  Shown shown = shown_between(first, last, glm::length(way), share);
  shown.height = std::min(shown.height, std::max({most_height, first, last}));
  const bool orthographic = from.is_orthographic() && to.is_orthographic();
  const double slope = std::exp(glm::mix(std::log(slope_at_end(from, orthographic)),
                                         std::log(slope_at_end(to, orthographic)), share));
  Pose pose;
  pose.turn = glm::normalize(glm::slerp(from.turn, to.turn, share));
  pose.vertical_fov_degrees = glm::degrees(2.0 * std::atan(slope));
  pose.orthographic_height = orthographic ? shown.height : 0.0;
  pose.focus = orthographic ? glm::mix(from.focus, to.focus, share) : shown.height / (2.0 * slope);
  pose.eye = start + shown.way * way + pose.focus * pose.backward();
  return pose;
}

Pose pose_of(const Transition& transition, const Limits& limits) {
  const double share = std::clamp(transition.elapsed / kTransitionSeconds, 0.0, 1.0);
  const Pose pose = pose_between(transition.from, transition.to, smoothstep(share),
                                 kFarthestRadii * limits.radius);
  const double depth =
      std::min(depth_of(transition.from, limits.centre), depth_of(transition.to, limits.centre));
  return set_back(limits, pose, depth);
}

}  // namespace relief
