// Between positions in an image and in the world, in double precision: everything is made relative
// to the eye first.
//
// Cursors are in pixels from the image's upper left corner, y downward; `size` is the image's, in
// pixels, both sides above 0.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "common/scene/camera.h"

namespace relief {

/// A half line, world units.
struct Ray {
  glm::dvec3 origin{0.0};
  glm::dvec3 direction{0.0, 0.0, -1.0};  ///< of length 1
};

/// Returns the ray that is seen at a cursor. It begins at the eye, or in the plane through the eye
/// of an orthographic camera.
[[nodiscard]] Ray ray_through(const Camera& camera, glm::dvec2 cursor, glm::dvec2 size);

/// Returns where a point is seen, possibly outside the image; none if it is not before the eye.
[[nodiscard]] std::optional<glm::dvec2> project(const Camera& camera, glm::dvec3 world,
                                                glm::dvec2 size);

/// Returns how far before the eye a point is, along the line of sight; below 0 behind it.
[[nodiscard]] double depth_of(const Camera& camera, glm::dvec3 world);

/// Returns the point that is seen at a cursor at a depth.
[[nodiscard]] glm::dvec3 world_at(const Camera& camera, glm::dvec2 cursor, double depth,
                                  glm::dvec2 size);

/// Returns how much of the world the height of the image shows at a depth.
[[nodiscard]] double image_height_at(const Camera& camera, double depth);

}  // namespace relief
