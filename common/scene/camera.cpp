#include "common/scene/camera.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace relief {

Camera orbit_camera(glm::dvec3 centre, double radius, const Orbit& orbit,
                    double vertical_fov_degrees, double aspect) {
  const double half_vertical = glm::radians(vertical_fov_degrees) / 2.0;
  const double half_smaller = std::atan(std::tan(half_vertical) * std::min(aspect, 1.0));
  const double distance = radius * (orbit.distance_in_radii > 0.0 ? orbit.distance_in_radii
                                                                  : 1.0 / std::sin(half_smaller));
  const double azimuth = glm::radians(orbit.azimuth_degrees);
  const double elevation = glm::radians(orbit.elevation_degrees);
  const glm::dvec3 outward(std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
                           std::cos(azimuth) * std::cos(elevation));
  // Straight from above or below +Y is no usable up: there -Z (or +Z) points up in the image.
  const glm::dvec3 up(-std::sin(azimuth) * std::sin(elevation), std::cos(elevation),
                      -std::cos(azimuth) * std::sin(elevation));
  return {centre + distance * outward, centre, up, vertical_fov_degrees};
}

double fitting_height(const Camera& camera, glm::dvec3 centre, double radius, double aspect) {
  const glm::dvec3 middle = view_rotation(camera) * (centre - camera.eye);
  const double half_width = std::abs(middle.x) + radius;
  const double half_height = std::abs(middle.y) + radius;
  return 2.0 * std::max(half_height, half_width / aspect);
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
