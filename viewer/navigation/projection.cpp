#include "viewer/navigation/projection.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

namespace relief {
namespace {

/// How much of the world a pixel shows, at depth 1 or, orthographic, at any depth.
double pixel_size(const Camera& camera, glm::dvec2 size) {
  return image_height_at(camera, 1.0) / size.y;
}

/// The cursor right and up of the image's middle, in the units of pixel_size().
glm::dvec2 from_middle(const Camera& camera, glm::dvec2 cursor, glm::dvec2 size) {
  return pixel_size(camera, size) * glm::dvec2(cursor.x - 0.5 * size.x, 0.5 * size.y - cursor.y);
}

}  // namespace

Ray ray_through(const Camera& camera, glm::dvec2 cursor, glm::dvec2 size) {
  const glm::dmat3 to_world = glm::transpose(view_rotation(camera));
  const glm::dvec2 across = from_middle(camera, cursor, size);
  if (camera.is_orthographic())
    return {camera.eye + to_world * glm::dvec3(across, 0.0), -to_world[2]};
  return {camera.eye, glm::normalize(to_world * glm::dvec3(across, -1.0))};
}

std::optional<glm::dvec2> project(const Camera& camera, glm::dvec3 world, glm::dvec2 size) {
  const glm::dvec3 seen = view_rotation(camera) * (world - camera.eye);
  if (!(seen.z < 0.0)) return std::nullopt;
  const double scale = camera.is_orthographic() ? 1.0 : -1.0 / seen.z;
  const glm::dvec2 pixels = scale / pixel_size(camera, size) * glm::dvec2(seen);
  return glm::dvec2(0.5 * size.x + pixels.x, 0.5 * size.y - pixels.y);
}

double depth_of(const Camera& camera, glm::dvec3 world) {
  return -(view_rotation(camera) * (world - camera.eye)).z;
}

glm::dvec3 world_at(const Camera& camera, glm::dvec2 cursor, double depth, glm::dvec2 size) {
  const glm::dvec2 across = from_middle(camera, cursor, size);
  const glm::dvec3 seen =
      camera.is_orthographic() ? glm::dvec3(across, -depth) : depth * glm::dvec3(across, -1.0);
  return camera.eye + glm::transpose(view_rotation(camera)) * seen;
}

double image_height_at(const Camera& camera, double depth) {
  if (camera.is_orthographic()) return camera.orthographic_height;
  return 2.0 * depth * std::tan(glm::radians(camera.vertical_fov_degrees) / 2.0);
}

}  // namespace relief
