#include "viewer/navigation/turn.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>

namespace relief {
namespace {

/// Radius about the image's middle without a roll, as a share of its smaller side.
constexpr double kStillShare = 0.05;

glm::dquat turntable(const Pose& pose, glm::dvec2 angles, glm::dvec3 axis) {
  // The elevation of a level camera; beyond 90 degrees of one that is upside down. A camera whose
  // horizontal is not level never comes to the pole, but turns over at 90 degrees all the same.
  const double upright = glm::dot(pose.up(), axis);
  const double elevation = std::atan2(glm::dot(pose.backward(), axis), upright);
  const double most = glm::radians(kMostElevation);
  const double then =
      std::clamp(elevation + angles.y, std::min(-most, elevation), std::max(most, elevation));
  const double side = upright < 0.0 ? angles.x : -angles.x;
  return glm::angleAxis(side, axis) * glm::angleAxis(elevation - then, pose.right());
}

glm::dquat trackball(const Pose& pose, glm::dvec2 angles) {
  const double angle = glm::length(angles);
  if (!(angle > 0.0)) return {1.0, 0.0, 0.0, 0.0};
  const glm::dvec2 share = angles / angle;
  return glm::angleAxis(-angle, glm::normalize(share.y * pose.right() + share.x * pose.up()));
}

}  // namespace

Pose orbited(const Pose& pose, glm::dvec3 about, glm::dvec2 shift, double angle, OrbitStyle style,
             glm::dvec3 axis) {
  const glm::dvec2 angles = angle * shift;
  return turned(
      pose,
      style == OrbitStyle::Turntable ? turntable(pose, angles, axis) : trackball(pose, angles),
      about);
}

double angle_about_middle(glm::dvec2 from, glm::dvec2 to, glm::dvec2 size) {
  const glm::dvec2 a = from - 0.5 * size;
  const glm::dvec2 b = to - 0.5 * size;
  if (std::min(glm::length(a), glm::length(b)) < kStillShare * std::min(size.x, size.y)) return 0.0;
  return std::atan2(a.x * b.y - a.y * b.x, glm::dot(a, b));
}

Pose rolled(const Pose& pose, double angle) {
  return turned(pose, glm::angleAxis(angle, pose.backward()), pose.eye);
}

}  // namespace relief
