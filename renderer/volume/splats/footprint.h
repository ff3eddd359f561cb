// What a kernel leaves in an image: its footprint [Zwicker 2002, Eq. (33)].
#pragma once

#include <glm/vec2.hpp>
#include <optional>

#include "renderer/volume/kernels/kernel_cloud.h"
#include "renderer/volume/settings.h"
#include "renderer/volume/splats/ray_space.h"

namespace relief {

/// Variance of the low-pass filter, pixels squared: of volumes a unit Gaussian, and of 3D Gaussians
/// what [Kerbl 2023] adds. Those trained with a filter that keeps the integral had the latter, too.
inline constexpr double kLowPassVariance = 1.0;
inline constexpr double kDilation = 0.3;

/// An elliptical Gaussian in the image: peak * exp(-q / 2) where q = x^T Q x is below the cutoff.
struct Footprint {
  glm::dvec2 centre{0.0};  ///< pixels from the lower left corner
  double peak = 0.0;       ///< optical depth (Integral) or opacity (Peak) there
  /// Q, the inverse of the filtered variance, 1 / pixels squared.
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  glm::dvec2 reach{0.0};  ///< half the sides of the box that holds it, pixels
  double cutoff = 0.0;    ///< of q
  double depth = 0.0;     ///< as ProjectedKernel's
  glm::dvec2 slope{0.0};
  double depth_deviation = 0.0;

  [[nodiscard]] double q(glm::dvec2 from_centre) const {
    return xx * from_centre.x * from_centre.x + 2.0 * xy * from_centre.x * from_centre.y +
           yy * from_centre.y * from_centre.y;
  }
};

/// How kernels become footprints: the settings with their defaults resolved.
struct FootprintRule {
  KernelWeight weight = KernelWeight::Integral;
  VolumeFilter filter = VolumeFilter::Ewa;
  double cutoff = 4.0;  ///< of q; 0: where the alpha falls below `min_alpha`
  double min_alpha = 0.0;
  double near = 0.0;            ///< world units; 0: one standard deviation of the kernel
  double jacobian_clamp = 0.0;  ///< as GaussianSettings'
  glm::dvec2 edge{0.0};         ///< |x / z| and |y / z| of the image's edges
};

/// The rule for kernels of that weight.
[[nodiscard]] FootprintRule footprint_rule(const VolumeSettings& settings, KernelWeight weight,
                                           bool is_antialiased, const View& view);

/// The footprint of kernel k. None if its centre is nearer than the rule's `near` before the eye's
/// plane, or behind it: there the affine approximation has no meaning. None either if it is too
/// faint, or not finite. An integral is scaled so that what lies beyond the cutoff is not lost.
/// `in_camera`: the kernel's variance in camera space.
[[nodiscard]] std::optional<Footprint> footprint_of(const KernelCloud& cloud, std::size_t k,
                                                    const RayCamera& camera,
                                                    const FootprintRule& rule,
                                                    const Variance& in_camera);
[[nodiscard]] inline std::optional<Footprint> footprint_of(const KernelCloud& cloud, std::size_t k,
                                                           const RayCamera& camera,
                                                           const FootprintRule& rule) {
  return footprint_of(cloud, k, camera, rule, to_camera(camera, cloud.variance(k)));
}

}  // namespace relief
