#include "renderer/engines/ewa/resampling_filter.h"

#include <cassert>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>

namespace relief::ewa {
namespace {

/// A Gaussian's exponent 1/2 x^T V^-1 x as a quadratic form, and the square root of |V|.
struct Gaussian {
  glm::dvec3 form{0.0};
  double root = 0.0;
};

Gaussian gaussian(const glm::dmat2& variance) {
  const double determinant = glm::determinant(variance);
  return {glm::dvec3(0.5 * variance[1][1], -variance[0][1], 0.5 * variance[0][0]) / determinant,
          std::sqrt(determinant)};
}

/// Half the box about the ellipse that 1/2 x^T V^-1 x = cutoff draws: the support function of an
/// ellipse along an axis is the root of that axis's variance.
glm::dvec2 box_of(const glm::dmat2& variance, double cutoff) {
  return glm::sqrt(2.0 * cutoff * glm::dvec2(variance[0][0], variance[1][1]));
}

double larger_eigenvalue(const glm::dmat2& m) {
  const double half_difference = 0.5 * (m[0][0] - m[1][1]);
  return 0.5 * (m[0][0] + m[1][1]) + std::hypot(half_difference, m[0][1]);
}

/// Whether a kernel can be evaluated without a NaN.
template <class Kernel>
bool is_finite(const Kernel& k) {
  return std::isfinite(k.peak) && std::isfinite(k.form.x + k.form.y + k.form.z) &&
         std::isfinite(k.extent.x + k.extent.y) && std::isfinite(k.centre.x + k.centre.y);
}

}  // namespace

std::optional<TangentMapping> map_tangent_plane(const PixelMapping& mapping, glm::dvec3 point,
                                                glm::dvec3 normal) {
  assert(point.z > 0.0 && "the point is before the eye");
  const glm::dvec3 ray = mapping.orthographic ? glm::dvec3(0.0, 0.0, 1.0) : point / point.z;
  const double along = glm::dot(normal, ray);
  if (!(std::abs(along) >= kMinCosine * glm::length(ray))) return std::nullopt;
  // A pixel's step at the point's depth, moved along the ray until it lies in the plane.
  const double step = mapping.orthographic ? 1.0 / mapping.scale : point.z / mapping.scale;
  const glm::dvec3 x0 = step * (glm::dvec3(1, 0, 0) - normal.x / along * ray);
  const glm::dvec3 x1 = step * (glm::dvec3(0, 1, 0) - normal.y / along * ray);
  const glm::dvec3 u0 = glm::normalize(x0);
  const glm::dvec3 u1 = glm::cross(normal, u0);
  TangentMapping plane;
  plane.centre = pixel_of(mapping, point);
  plane.to_plane = glm::dmat2(glm::length(x0), 0.0, glm::dot(x1, u0), glm::dot(x1, u1));
  plane.to_pixels = glm::inverse(plane.to_plane);
  plane.area = std::abs(glm::determinant(plane.to_pixels));
  return plane;
}

std::optional<ScreenKernel> screen_kernel(const TangentMapping& mapping, double radius,
                                          EwaFilter filter, double cutoff) {
  assert(filter != EwaFilter::SourceSpace && "that one is made by source_kernel");
  const double area = radius * radius * mapping.area;
  if (!(area >= kMinArea)) return std::nullopt;
  glm::dmat2 variance = radius * radius * mapping.to_pixels * glm::transpose(mapping.to_pixels);
  if (filter != EwaFilter::Unfiltered) variance += glm::dmat2(1.0);
  if (filter == EwaFilter::Circular) variance = glm::dmat2(larger_eigenvalue(variance));
  const Gaussian g = gaussian(variance);
  ScreenKernel kernel{mapping.centre, g.form, area / (2.0 * std::numbers::pi * g.root),
                      box_of(variance, cutoff)};
  if (filter == EwaFilter::Unfiltered && std::max(kernel.extent.x, kernel.extent.y) < 0.5)
    kernel.centre = glm::floor(kernel.centre) + 0.5;
  if (!is_finite(kernel)) return std::nullopt;
  return kernel;
}

std::optional<SourceKernel> source_kernel(const TangentMapping& mapping, double radius,
                                          double cutoff) {
  if (!(radius * radius * mapping.area >= kMinArea)) return std::nullopt;
  const glm::dmat2 variance =
      glm::dmat2(radius * radius) + mapping.to_plane * glm::transpose(mapping.to_plane);
  const Gaussian g = gaussian(variance);
  const glm::dmat2 in_pixels = mapping.to_pixels * variance * glm::transpose(mapping.to_pixels);
  const SourceKernel kernel{mapping.centre, mapping.to_plane, g.form,
                            radius * radius / (2.0 * std::numbers::pi * g.root),
                            box_of(in_pixels, cutoff)};
  if (!is_finite(kernel)) return std::nullopt;
  return kernel;
}

}  // namespace relief::ewa
