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

Variance to_camera(const RayCamera& camera, const Variance& variance) {
  return variance_of(camera.rotation * matrix_of(variance) * glm::transpose(camera.rotation));
}

ProjectedKernel project_kernel(const RayCamera& camera, glm::dvec3 t, const Variance& v,
                               glm::dvec3 jacobian_at) {
  ProjectedKernel projected;
  projected.centre =
      camera.middle + camera.scale * glm::dvec2(t) / (camera.orthographic ? 1.0 : t.z);
  projected.depth = t.z;
  // The Jacobian's rows (ray_space_jacobian()) are a (1, 0, -x) and b (0, 1, -y). The third is the
  // depth along the axis: what slabs, opaque surfaces and the depth output are given in.
  const glm::dvec3 at = jacobian_at;
  const double depth = camera.orthographic ? 1.0 : at.z;
  const double a = camera.scale.x / depth;
  const double b = camera.scale.y / depth;
  const double x = camera.orthographic ? 0.0 : at.x / depth;
  const double y = camera.orthographic ? 0.0 : at.y / depth;
  projected.area = std::abs(a * b) * (camera.orthographic ? 1.0 : glm::length(at) / depth);
  const double x_depth = v.xz - x * v.zz;
  const double y_depth = v.yz - y * v.zz;
  projected.xx = a * a * (v.xx - x * v.xz - x * x_depth);
  projected.xy = a * b * (v.xy - x * v.yz - y * x_depth);
  projected.yy = b * b * (v.yy - y * v.yz - y * y_depth);
  const double determinant = projected.xx * projected.yy - projected.xy * projected.xy;
  double along = v.zz;
  if (determinant > 0.0) {
    const glm::dvec2 c(a * x_depth, b * y_depth);
    projected.slope = glm::dvec2(projected.yy * c.x - projected.xy * c.y,
                                 projected.xx * c.y - projected.xy * c.x) /
                      determinant;
    along -= glm::dot(projected.slope, c);
  }
  projected.depth_deviation = std::sqrt(std::max(along, 0.0));
  return projected;
}

}  // namespace relief
