#include "common/scene/camera.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace relief {

Camera orbit_camera(glm::dvec3 centre, double radius, const Orbit& orbit,
                    double vertical_fov_degrees, double aspect, const Stance& stance) {
  const double half_vertical = glm::radians(vertical_fov_degrees) / 2.0;
  const double half_smaller = std::atan(std::tan(half_vertical) * std::min(aspect, 1.0));
  const double distance = radius * (orbit.distance_in_radii > 0.0 ? orbit.distance_in_radii
                                                                  : 1.0 / std::sin(half_smaller));
  const double azimuth = glm::radians(orbit.azimuth_degrees);
  const double elevation = glm::radians(orbit.elevation_degrees);
  const glm::dvec3 side = glm::cross(stance.up, stance.front);
  const glm::dvec3 level = std::sin(azimuth) * side + std::cos(azimuth) * stance.front;
  const glm::dvec3 outward = std::cos(elevation) * level + std::sin(elevation) * stance.up;
  // Straight from above or below, the stance's own up direction is no usable one.
  const glm::dvec3 up = std::cos(elevation) * stance.up - std::sin(elevation) * level;
  return {centre + distance * outward, centre, up, vertical_fov_degrees};
}

Camera rolled(const Camera& camera, double degrees) {
  if (degrees == 0.0) return camera;
  const glm::dmat3 axes = glm::transpose(view_rotation(camera));
  Camera turned = camera;
  turned.up = std::cos(glm::radians(degrees)) * axes[1] - std::sin(glm::radians(degrees)) * axes[0];
  return turned;
}

Camera zoomed(const Camera& camera, double factor) {
  if (factor == 1.0) return camera;
  Camera nearer = camera;
  const double slope = std::tan(glm::radians(camera.vertical_fov_degrees) / 2.0);
  nearer.vertical_fov_degrees = glm::degrees(2.0 * std::atan(slope / factor));
  nearer.orthographic_height /= factor;
  return nearer;
}

glm::dmat3 view_rotation(const Camera& camera) {
  const glm::dvec3 backward = glm::normalize(camera.eye - camera.target);
  glm::dvec3 right = glm::cross(camera.up, backward);
  if (glm::length(right) < 1e-12 * glm::length(camera.up)) {
    // `up` runs along the view: any other direction is as good.
    right = glm::cross(std::abs(backward.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1),
                       backward);
  }
  right = glm::normalize(right);
  return glm::transpose(glm::dmat3(right, glm::cross(backward, right), backward));
}

glm::mat4 reversed_infinite_projection(double vertical_fov_degrees, double aspect, double near) {
  const double f = 1.0 / std::tan(glm::radians(vertical_fov_degrees) / 2.0);
  glm::mat4 m(0.0F);
  m[0][0] = static_cast<float>(f / aspect);
  m[1][1] = static_cast<float>(f);
  m[2][3] = -1.0F;
  m[3][2] = static_cast<float>(near);
  return m;
}

glm::dmat4 reversed_orthographic_projection(const OrthographicBox& box) {
  const double range = box.far - box.near;
  glm::dmat4 m(0.0);
  m[0][0] = 1.0 / box.half_width;
  m[1][1] = 1.0 / box.half_height;
  m[2][2] = 1.0 / range;  // eye coordinates have -z ahead
  m[3][2] = box.far / range;
  m[3][3] = 1.0;
  return m;
}

}  // namespace relief
