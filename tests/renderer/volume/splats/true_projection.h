// The true projection of a kernel, by numerical integration along rays: no affine approximation.
#pragma once

#include <glm/vec3.hpp>

#include "renderer/volume/kernels/kernel_cloud.h"
#include "renderer/volume/splats/ray_space.h"

namespace relief {

/// A Gaussian whose integral over space is 1.
struct TrueKernel {
  glm::dvec3 centre{0.0};  ///< camera space
  Variance variance;
};

/// The integral of the kernel along the ray from the eye (the origin) through `through`: its true
/// footprint there. By adaptive Simpson integration, within 1e-10 of the integral along a ray
/// through the centre; what is behind the eye does not count.
[[nodiscard]] double integral_along(const TrueKernel& kernel, glm::dvec3 through);

/// A camera at the origin along +z with pixels of 1 / focal.
[[nodiscard]] RayCamera camera_along_z(double focal);

/// At distance 1, so many degrees off that camera's axis, to the right.
[[nodiscard]] glm::dvec3 centre_at(double degrees);

[[nodiscard]] Variance round_variance(double sigma);

}  // namespace relief
