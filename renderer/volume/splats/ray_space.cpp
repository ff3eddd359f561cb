#include "renderer/volume/splats/ray_space.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace relief {

RayCamera ray_camera(const View& view) {
  RayCamera camera;
  camera.eye = view.eye;
  camera.rotation = view.rotation;
  for (int column = 0; column < 3; ++column) camera.rotation[column].z *= -1.0;
  camera.orthographic = view.orthographic;
  const glm::dvec2 half(0.5 * view.width, 0.5 * view.height);
  camera.scale = half / glm::dvec2(view.slope_x, view.slope_y);
  camera.middle = half - camera.scale * view.middle;
  return camera;
}

glm::dvec3 to_ray_space(const RayCamera& camera, glm::dvec3 t) {
  if (camera.orthographic) return {camera.middle + camera.scale * glm::dvec2(t), t.z};
  return {camera.middle + camera.scale * glm::dvec2(t) / t.z, glm::length(t)};
}

glm::dmat3 ray_space_jacobian(const RayCamera& camera, glm::dvec3 t) {
  const glm::dvec2 s = camera.scale;
  if (camera.orthographic) return {{s.x, 0.0, 0.0}, {0.0, s.y, 0.0}, {0.0, 0.0, 1.0}};
  const double l = glm::length(t);
  return {{s.x / t.z, 0.0, t.x / l},
          {0.0, s.y / t.z, t.y / l},
          {-s.x * t.x / (t.z * t.z), -s.y * t.y / (t.z * t.z), t.z / l}};
}

ProjectedKernel project_kernel(const RayCamera& camera, glm::dvec3 t, const Variance& variance,
                               glm::dvec3 jacobian_at) {
  ProjectedKernel projected;
  const glm::dvec3 place = to_ray_space(camera, t);
  projected.centre = glm::dvec2(place);
  projected.depth = t.z;
  glm::dmat3 jacobian = ray_space_jacobian(camera, jacobian_at);
  projected.area = std::abs(glm::determinant(jacobian));
  // The third coordinate is the depth along the axis from here on: what slabs, opaque surfaces and
  // the depth output are given in. The footprint does not have it.
  jacobian[0].z = 0.0;
  jacobian[1].z = 0.0;
  jacobian[2].z = 1.0;
  const glm::dmat3 to_image = jacobian * camera.rotation;
  const glm::dmat3 v = to_image * matrix_of(variance) * glm::transpose(to_image);
  projected.xx = v[0].x;
  projected.xy = v[1].x;
  projected.yy = v[1].y;
  const double determinant = projected.xx * projected.yy - projected.xy * projected.xy;
  double along = v[2].z;
  if (determinant > 0.0) {
    const glm::dvec2 c(v[2].x, v[2].y);
    projected.slope = glm::dvec2(projected.yy * c.x - projected.xy * c.y,
                                 projected.xx * c.y - projected.xy * c.x) /
                      determinant;
    along -= glm::dot(projected.slope, c);
  }
  projected.depth_deviation = std::sqrt(std::max(along, 0.0));
  return projected;
}

double deviation_along_axis(const RayCamera& camera, const Variance& variance) {
  const glm::dvec3 axis(camera.rotation[0].z, camera.rotation[1].z, camera.rotation[2].z);
  return std::sqrt(std::max(glm::dot(axis, matrix_of(variance) * axis), 0.0));
}

}  // namespace relief
