#include "renderer/volume/splats/footprint.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace relief {
namespace {

constexpr double kCutoffOfVolumes = 4.0;  ///< two standard deviations: 13.5 % lie beyond

/// A symmetric 2 x 2 matrix, pixels squared.
struct ImageVariance {
  double xx;
  double xy;
  double yy;

  [[nodiscard]] double determinant() const { return xx * yy - xy * xy; }
  [[nodiscard]] double smaller_eigenvalue() const {
    const double half = 0.5 * (xx + yy);
    const double root = std::hypot(0.5 * (xx - yy), xy);
    // Without cancellation for long, thin ellipses.
    return half + root > 0.0 ? determinant() / (half + root) : 0.0;
  }
};

ImageVariance widened(ImageVariance v, double by) {
  return {v.xx + by, v.xy, v.yy + by};
}

ImageVariance filtered(ImageVariance v, VolumeFilter filter, KernelWeight weight) {
  switch (filter) {
    case VolumeFilter::Ewa:
      return widened(v, weight == KernelWeight::Peak ? kDilation : kLowPassVariance);
    case VolumeFilter::Dilated:
      return widened(v, kDilation);
    case VolumeFilter::UniformScaling: {
      const double minor = v.smaller_eigenvalue();
      if (minor >= kLowPassVariance) return v;
      if (!(minor > 0.0)) return widened(v, kLowPassVariance);  // a needle has no shape to keep
      const double factor = kLowPassVariance / minor;
      return {v.xx * factor, v.xy * factor, v.yy * factor};
    }
    case VolumeFilter::Automatic:
    case VolumeFilter::Unfiltered:
      break;
  }
  return v;
}

/// The place whose Jacobian is taken: not farther from the axis than the rule says.
glm::dvec3 clamped(glm::dvec3 t, const FootprintRule& rule) {
  if (rule.jacobian_clamp <= 0.0) return t;
  const glm::dvec2 limit = rule.jacobian_clamp * rule.edge;
  return {std::clamp(t.x / t.z, -limit.x, limit.x) * t.z,
          std::clamp(t.y / t.z, -limit.y, limit.y) * t.z, t.z};
}

/// The length of a ray in a layer across the normal, for a layer of thickness 1.
double path_in_layer(const RayCamera& camera, glm::dvec3 t, glm::dvec3 normal) {
  const glm::dvec3 n = camera.rotation * normal;
  const double cosine =
      std::abs(camera.orthographic ? n.z : glm::dot(n, t) / std::max(glm::length(t), 1e-300));
  return 1.0 / std::max(cosine, 1e-6);
}

}  // namespace

FootprintRule footprint_rule(const VolumeSettings& settings, KernelWeight weight,
                             bool is_antialiased, const View& view) {
  const bool is_peak = weight == KernelWeight::Peak;
  FootprintRule rule;
  rule.weight = weight;
  rule.filter = settings.filter;
  if (rule.filter == VolumeFilter::Automatic)
    rule.filter = is_peak && !is_antialiased ? VolumeFilter::Dilated : VolumeFilter::Ewa;
  rule.cutoff = settings.cutoff;
  if (is_peak) {
    rule.min_alpha = settings.gaussians.min_alpha;
    if (!view.orthographic) {
      rule.near = settings.gaussians.near;
      rule.jacobian_clamp = settings.gaussians.jacobian_clamp;
    }
  } else if (rule.cutoff == 0.0) {
    rule.cutoff = kCutoffOfVolumes;
  }
  rule.edge = {view.slope_x + std::abs(view.middle.x), view.slope_y + std::abs(view.middle.y)};
  return rule;
}

std::optional<Footprint> footprint_of(const KernelCloud& cloud, std::size_t k,
                                      const RayCamera& camera, const FootprintRule& rule,
                                      const Variance& in_camera) {
  const glm::dvec3 t = to_camera(camera, cloud.centres[k]);
  const bool is_peak = rule.weight == KernelWeight::Peak;
  const double near = is_peak               ? rule.near
                      : camera.orthographic ? 0.0
                                            : std::sqrt(std::max(in_camera.zz, 0.0));
  if (!(t.z > near)) return std::nullopt;
  const ProjectedKernel projected = project_kernel(camera, t, in_camera, clamped(t, rule));
  const ImageVariance v{projected.xx, projected.xy, projected.yy};
  const ImageVariance f = filtered(v, rule.filter, rule.weight);
  const double determinant = f.determinant();
  if (!(determinant > 0.0) || !std::isfinite(determinant)) return std::nullopt;

  Footprint footprint;
  footprint.centre = projected.centre;
  footprint.xx = f.yy / determinant;
  footprint.xy = -f.xy / determinant;
  footprint.yy = f.xx / determinant;
  footprint.depth = projected.depth;
  footprint.slope = projected.slope;
  footprint.depth_deviation = projected.depth_deviation;
  footprint.cutoff = rule.cutoff;
  const double weight = cloud.weights[k];
  if (is_peak) {
    footprint.peak = weight;
    // What the low-pass filter spreads it takes from the centre.
    if (rule.filter == VolumeFilter::Ewa)
      footprint.peak *= std::sqrt(std::max(v.determinant(), 0.0) / determinant);
    if (!(footprint.peak > rule.min_alpha)) return std::nullopt;
    if (footprint.cutoff == 0.0)
      footprint.cutoff = 2.0 * std::log(footprint.peak / std::max(rule.min_alpha, 1e-9));
  } else {
    const double kept = 1.0 - std::exp(-0.5 * rule.cutoff);
    footprint.peak =
        weight * projected.area / (2.0 * std::numbers::pi * std::sqrt(determinant) * kept);
    if (!cloud.is_surface.empty() && cloud.is_surface[k] != 0)
      footprint.peak /= path_in_layer(camera, t, glm::dvec3(cloud.normals[k]));
  }
  footprint.reach =
      glm::dvec2(std::sqrt(footprint.cutoff * f.xx), std::sqrt(footprint.cutoff * f.yy));
  const bool is_finite = std::isfinite(footprint.peak) && std::isfinite(footprint.reach.x) &&
                         std::isfinite(footprint.reach.y) && std::isfinite(footprint.centre.x) &&
                         std::isfinite(footprint.centre.y);
  return is_finite ? std::optional(footprint) : std::nullopt;
}

}  // namespace relief
