// The points of a model that lie farthest out: few, and enough to frame it from any side.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "common/bounds.h"

namespace relief {

/// Coordinates of extreme points are kept in this many steps of the bounds, so that 16 bits hold
/// them.
inline constexpr double kExtremeSteps = 65535.0;

/// Returns, for each of 98 directions, a point that lies farthest in it, each once, sorted. The
/// directions are spread about the cube into which `bounds` is scaled; no other point of an
/// ellipsoid lies more than 5 % of its half width farther out in any direction. Points outside the
/// bounds are clamped to them. World frame. Empty without points.
[[nodiscard]] std::vector<glm::dvec3> extreme_points(std::span<const glm::dvec3> positions,
                                                     const Bounds& bounds);

/// Returns the eight corners of a box; none of an empty one.
[[nodiscard]] std::vector<glm::dvec3> corners_of(const Bounds& bounds);

/// Returns the position of an extreme point from its steps, and its steps from its position.
[[nodiscard]] glm::dvec3 extreme_at(const glm::u16vec3& steps, const Bounds& bounds);
[[nodiscard]] glm::u16vec3 extreme_steps(const glm::dvec3& position, const Bounds& bounds);

}  // namespace relief
