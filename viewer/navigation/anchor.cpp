#include "viewer/navigation/anchor.h"

#include <algorithm>
#include <cmath>
#include <glm/vector_relational.hpp>

#include "viewer/navigation/projection.h"

namespace relief {
namespace {

bool is_in_image(const Pose& pose, glm::dvec3 point, glm::dvec2 size, const Limits& limits) {
  if (depth_of(pose, point) < least_depth(limits, pose)) return false;
  const auto pixel = project(camera_of(pose, glm::dvec3(0.0)), point, size);
  return pixel && glm::all(glm::greaterThanEqual(*pixel, glm::dvec2(0.0))) &&
         glm::all(glm::lessThanEqual(*pixel, size));
}

}  // namespace

std::optional<glm::dvec3> usable_point(const Pose& pose, const std::optional<glm::dvec3>& under) {
  if (!under) return std::nullopt;
  const double depth = depth_of(pose, *under);
  return depth > 0.0 && std::isfinite(depth) ? under : std::nullopt;
}

double background_depth(const Pose& pose, glm::dvec3 pivot, const Limits& limits) {
  const double depth = depth_of(pose, pivot);
  const double least = least_depth(limits, pose);
  return depth >= least ? depth : std::max(pose.focus, least);
}

glm::dvec3 background_point(const Pose& pose, glm::dvec2 cursor, glm::dvec2 size, glm::dvec3 pivot,
                            const Limits& limits) {
  return world_at(camera_of(pose, glm::dvec3(0.0)), cursor, background_depth(pose, pivot, limits),
                  size);
}

glm::dvec3 background_pivot(const Pose& pose, glm::dvec2 size, glm::dvec3 pivot,
                            const Limits& limits) {
  if (is_in_image(pose, pivot, size, limits)) return pivot;
  if (is_in_image(pose, limits.centre, size, limits)) return limits.centre;
  return background_point(pose, 0.5 * size, size, pivot, limits);
}

}  // namespace relief
