#include "viewer/navigation/move.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace relief {
namespace {

/// What a frame that took long may fly at once, in distances ahead.
constexpr double kMostAtOnce = 2.0;

/// An orthographic image's height, enlarged by `factor` below 1 within the limits.
double limited_height(double height, double factor, const Limits& limits) {
  const double least = std::min(limits.least_height, height);
  const double most = std::max(kFarthestRadii * limits.radius, height);
  return std::clamp(height * factor, least, most);
}

Pose zoomed_orthographic(const Pose& pose, double factor, glm::dvec3 point, const Limits& limits) {
  const glm::dvec3 beside = point + depth_of(pose, point) * pose.backward();  // the eye
  const double asked = std::min(factor, farthest_factor(limits, pose, beside));
  Pose result = pose;
  result.orthographic_height = limited_height(pose.orthographic_height, asked, limits);
  const double share = result.orthographic_height / pose.orthographic_height;
  result.eye = beside + share * (pose.eye - beside);
  return result;
}

}  // namespace

Pose panned(const Pose& pose, glm::dvec2 shift, double depth, double height) {
  const double pixel = image_height_at(pose, depth) / height;
  Pose result = pose;
  result.eye += pixel * (shift.y * pose.up() - shift.x * pose.right());
  return result;
}

Pose zoomed(const Pose& pose, double steps, glm::dvec3 point, const Limits& limits) {
  const double asked = std::pow(kZoomStep, -steps);
  if (pose.is_orthographic()) return zoomed_orthographic(pose, asked, point, limits);
  const double depth = depth_of(pose, point);
  const double nearest = std::min(least_depth(limits, pose) / depth, 1.0);
  const double factor = asked < 1.0 ? std::max(asked, nearest)
                                    : std::min(asked, farthest_factor(limits, pose, point));
  Pose result = pose;
  result.eye = point + factor * (pose.eye - point);
  result.focus = factor * depth;
  return result;
}

Pose flown(const Pose& pose, const Flight& flight, const Limits& limits) {
  const glm::dvec3 way = glm::clamp(flight.seconds * flight.direction, glm::dvec3(-kMostAtOnce),
                                    glm::dvec3(kMostAtOnce));
  Pose result = pose;
  if (pose.is_orthographic()) {
    result.orthographic_height = limited_height(pose.orthographic_height, std::exp(-way.z), limits);
    result.eye += pose.orthographic_height * (way.x * pose.right() + way.y * flight.up);
  } else {
    double forward = -flight.distance * std::expm1(-way.z);
    if (flight.surface && forward > 0.0) {
      const double room = *flight.surface - least_depth(limits, pose);
      forward = std::min(forward, std::max(room, 0.0));
    }
    result.eye += flight.distance * (way.x * pose.right() + way.y * flight.up);
    result.eye -= forward * pose.backward();
  }
  return within_reach(limits, pose, result);
}

Pose with_projection(const Pose& pose, bool orthographic, double depth, const Limits& limits) {
  if (orthographic == pose.is_orthographic()) return pose;
  Pose result = pose;
  if (orthographic) {
    result.orthographic_height = image_height_at(pose, depth);
    result.focus = depth;
    return set_back(limits, result, clear_depth(limits));
  }
  result.focus = pose.orthographic_height / (2.0 * slope_of(pose));
  result.eye += (result.focus - depth) * pose.backward();
  result.orthographic_height = 0.0;
  return within_reach(limits, pose, result);
}

Pose with_field_of_view(const Pose& pose, double degrees, double depth, const Limits& limits) {
  Pose result = pose;
  result.vertical_fov_degrees = degrees;
  if (pose.is_orthographic()) return result;
  result.focus = depth * slope_of(pose) / slope_of(result);
  result.eye += (result.focus - depth) * pose.backward();
  return within_reach(limits, pose, result);
}

}  // namespace relief
