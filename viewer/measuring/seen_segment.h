// Lines of the world in an image.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "common/scene/camera.h"

namespace relief {

/// A line in an image, in pixels as project() has them (viewer/navigation/projection.h).
struct SeenSegment {
  glm::dvec2 from{0.0};
  glm::dvec2 to{0.0};
};

/// Returns what is seen of a line between two positions (world): the part before the eye, cut to
/// the image and `margin` pixels about it. None if nothing is.
[[nodiscard]] std::optional<SeenSegment> seen_segment(const Camera& camera, glm::dvec3 from,
                                                      glm::dvec3 to, glm::dvec2 size,
                                                      double margin);

/// Returns positions along the arc of an angle at `corner`, from the direction to `first` to that
/// to `last`, at a third of the shorter of both distances. Empty if one of them is 0 or the
/// directions are opposite, which leaves the arc's plane open.
[[nodiscard]] std::vector<glm::dvec3> angle_arc(glm::dvec3 first, glm::dvec3 corner,
                                                glm::dvec3 last);

/// Returns the corner of a height difference: below or above `from`, as high as `to`. `up`: of any
/// length but 0.
[[nodiscard]] glm::dvec3 height_corner(glm::dvec3 from, glm::dvec3 to, glm::dvec3 up);

}  // namespace relief
