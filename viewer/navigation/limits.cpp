#include "viewer/navigation/limits.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

namespace relief {
namespace {

/// The least image height in roundings of a coordinate: a pixel of 1000 then has 10 of them.
constexpr double kLeastRoundings = 1e4;

/// The same in radii, of a model whose spacing is unknown.
constexpr double kLeastRadii = 1e-6;

/// An orthographic eye's distance to the centre in radii: splats reach beyond the points.
constexpr double kClearRadii = 1.05;

double farthest_distance(const Limits& limits, const Pose& pose) {
  const double height = kFarthestRadii * limits.radius;
  return pose.is_orthographic() ? height : height / (2.0 * slope_of(pose));
}

}  // namespace

Limits limits_for(const PatchModel& extent, glm::dvec3 origin, double aspect) {
  Limits limits;
  const glm::dvec3 centre = 0.5 * (extent.bounds.min + extent.bounds.max);
  const double largest = glm::length(centre) + extent.bounding_radius;
  if (!(largest <= kMostCoordinate)) return limits;  // bounds that a hostile file has
  limits.centre = centre - origin;
  if (extent.bounding_radius > 0.0) limits.radius = extent.bounding_radius;
  const double steady = kLeastRoundings * std::numeric_limits<double>::epsilon() * largest;
  const double sample = extent.spacing > 0.0 && extent.spacing < limits.radius
                            ? extent.spacing / std::max(aspect, 1.0)
                            : kLeastRadii * limits.radius;
  limits.least_height = std::max(sample, steady);
  return limits;
}

double least_depth(const Limits& limits, const Pose& pose) {
  return limits.least_height / (2.0 * slope_of(pose));
}

double farthest_factor(const Limits& limits, const Pose& pose, glm::dvec3 point) {
  // | point - centre + factor * (eye - point) | = farthest
  const glm::dvec3 start = point - limits.centre;
  const glm::dvec3 way = pose.eye - point;
  const double farthest = farthest_distance(limits, pose);
  const double a = glm::dot(way, way);
  const double b = glm::dot(start, way);
  const double discriminant = b * b + a * (farthest * farthest - glm::dot(start, start));
  if (!(a > 0.0) || !(discriminant > 0.0)) return 1.0;
  return std::max((std::sqrt(discriminant) - b) / a, 1.0);
}

Pose within_reach(const Limits& limits, const Pose& before, const Pose& pose) {
  const double most =
      std::max(farthest_distance(limits, pose), glm::distance(before.eye, limits.centre));
  const double distance = glm::distance(pose.eye, limits.centre);
  if (distance <= most) return pose;
  Pose result = pose;
  result.eye = limits.centre + most / distance * (pose.eye - limits.centre);
  return result;
}

double clear_depth(const Limits& limits) {
  return kClearRadii * limits.radius;
}

Pose set_back(const Limits& limits, const Pose& pose, double depth) {
  if (!pose.is_orthographic()) return pose;
  const double missing = std::min(depth, clear_depth(limits)) - depth_of(pose, limits.centre);
  if (missing <= 0.0) return pose;
  Pose result = pose;
  result.eye += missing * pose.backward();
  result.focus += missing;
  return result;
}

Pose kept_before_model(const Limits& limits, const Pose& before, const Pose& pose) {
  return set_back(limits, pose, depth_of(before, limits.centre));
}

}  // namespace relief
