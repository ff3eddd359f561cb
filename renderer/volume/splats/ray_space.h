// Ray space: where projection is parallel [Zwicker 2002, section 6.2].
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "renderer/view/view.h"
#include "renderer/volume/kernels/kernel_cloud.h"

namespace relief {

/// The camera as ray space takes it. Camera space: x right, y up, z into the image.
struct RayCamera {
  glm::dvec3 eye{0.0};
  glm::dmat3 rotation{1.0};  ///< world to camera
  bool orthographic = false;
  glm::dvec2 scale{1.0};   ///< pixels for a unit of ray space
  glm::dvec2 middle{0.0};  ///< pixels from the lower left corner: where the axis is
};

[[nodiscard]] RayCamera ray_camera(const View& view);

/// From world to camera space.
[[nodiscard]] inline glm::dvec3 to_camera(const RayCamera& camera, glm::dvec3 position) {
  return camera.rotation * (position - camera.eye);
}

/// phi of Eq. (26): pixels from the lower left corner, and the distance from the eye along the ray
/// (world units). `t`: camera space; t.z above 0 but for an orthographic camera.
[[nodiscard]] glm::dvec3 to_ray_space(const RayCamera& camera, glm::dvec3 t);

/// Its Jacobian at t, Eq. (29), with the first two rows in pixels.
[[nodiscard]] glm::dmat3 ray_space_jacobian(const RayCamera& camera, glm::dvec3 t);

/// A kernel in the image, by the local affine approximation at its centre (Eq. (30) and (32)).
struct ProjectedKernel {
  glm::dvec2 centre{0.0};  ///< pixels from the lower left corner
  double depth = 0.0;      ///< of the centre along the view axis, world units
  /// Variance in the image, pixels squared.
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  /// How the mean depth changes over the image, and how much depths spread about it: a kernel's
  /// depths at a pixel are a Gaussian about depth + slope . (pixel - centre).
  glm::dvec2 slope{0.0};         ///< world units a pixel
  double depth_deviation = 0.0;  ///< world units
  /// |J|: pixels squared for a unit of world area across the ray. An integral over space becomes
  /// one along rays, summed over the image, if it is multiplied by it.
  double area = 0.0;
};

/// A variance (world) in camera space.
[[nodiscard]] Variance to_camera(const RayCamera& camera, const Variance& variance);

/// Of a kernel with that centre and variance (camera space). `jacobian_at`: the place whose
/// Jacobian is taken; the centre's own, but for clamped ones.
[[nodiscard]] ProjectedKernel project_kernel(const RayCamera& camera, glm::dvec3 t,
                                             const Variance& variance, glm::dvec3 jacobian_at);

}  // namespace relief
