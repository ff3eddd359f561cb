// The point that a movement refers to.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "viewer/navigation/limits.h"
#include "viewer/navigation/pose.h"

namespace relief {

/// Returns the surface point under the cursor, if it is finite and before the eye.
[[nodiscard]] std::optional<glm::dvec3> usable_point(const Pose& pose,
                                                     const std::optional<glm::dvec3>& under);

/// Returns the depth that stands for the background's: the pivot's, or the target's if the pivot is
/// not before the eye.
[[nodiscard]] double background_depth(const Pose& pose, glm::dvec3 pivot, const Limits& limits);

/// Returns the point of the background under a cursor, at that depth. `size`: of the image, pixels.
[[nodiscard]] glm::dvec3 background_point(const Pose& pose, glm::dvec2 cursor, glm::dvec2 size,
                                          glm::dvec3 pivot, const Limits& limits);

/// Returns what the background turns about: the pivot if it is in the image, else the model's
/// centre if that is, else the point in the image's middle at background_depth().
[[nodiscard]] glm::dvec3 background_pivot(const Pose& pose, glm::dvec2 size, glm::dvec3 pivot,
                                          const Limits& limits);

}  // namespace relief
