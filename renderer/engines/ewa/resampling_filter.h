// The resampling kernel of a point: its basis function, mapped to the image and band-limited
// ([Zwicker 2001], sections 3.3 and 4).
//
// Camera frame of this engine: x right, y down (as the rows of an image go), z forward, the eye at
// the origin. Pixels: x right, y down from the upper left corner, pixel (i, j) about (i + 1/2, j +
// 1/2).
#pragma once

#include <glm/mat2x2.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "renderer/engines/ewa/settings.h"

namespace relief::ewa {

/// How a camera maps points to pixels: pixel = scale * (x, y) / z + middle, orthographic without
/// the division.
struct PixelMapping {
  double scale = 1.0;  ///< pixels per unit at depth 1, the same in both directions
  glm::dvec2 middle{0.0};
  bool orthographic = false;
};

/// Where a point is mapped, in pixels.
[[nodiscard]] inline glm::dvec2 pixel_of(const PixelMapping& mapping, glm::dvec3 point) {
  if (mapping.orthographic) return mapping.scale * glm::dvec2(point) + mapping.middle;
  return mapping.scale * glm::dvec2(point) / point.z + mapping.middle;
}

/// The affine approximation, Eq. (4), of the mapping from a point's tangent plane to pixels. The
/// plane's coordinates are world units along two orthonormal vectors; which ones does not matter to
/// round basis functions.
struct TangentMapping {
  glm::dvec2 centre{0.0};     ///< m(u_k)
  glm::dmat2 to_plane{1.0};   ///< J^-1, world units per pixel
  glm::dmat2 to_pixels{1.0};  ///< J
  double area = 1.0;          ///< |J|, pixels per square world unit
};

/// The exact Jacobian at a point: J^-1 from the basis vectors of the screen projected along the
/// viewing ray onto the tangent plane (section 4, Figure 5). `point` and `normal` (unit, either
/// side) in the camera frame, the point before the eye. Nothing for a plane seen edge-on: below
/// kMinCosine between the normal and the ray its kernel adds nothing to any pixel.
[[nodiscard]] std::optional<TangentMapping> map_tangent_plane(const PixelMapping& mapping,
                                                              glm::dvec3 point, glm::dvec3 normal);
inline constexpr double kMinCosine = 1e-3;

/// A resampling kernel: peak * exp(-beta), beta a quadratic form of the pixel's offset from the
/// centre, cut off where beta reaches the cutoff.
struct ScreenKernel {
  glm::dvec2 centre{0.0};
  glm::dvec3 form{0.0};    ///< beta(x, y) = form.x x^2 + form.y x y + form.z y^2, 1/2 x^T V^-1 x
  double peak = 0.0;       ///< h^2 |J| / (2 pi sqrt |V|)
  glm::dvec2 extent{0.0};  ///< half the box about the cut-off ellipse, pixels

  [[nodiscard]] double exponent(glm::dvec2 pixel) const {
    const glm::dvec2 x = pixel - centre;
    return (form.x * x.x + form.y * x.y) * x.x + form.z * x.y * x.y;
  }
};

/// The kernel of Eq. (6), times h^2: the basis function G(u / h) of a grid of side h and variance
/// h^2 then makes a partition of unity (sections 5 and 7), and the kernel's sum over all pixels is
/// the area in pixels of the h x h square that the point stands for, whatever the filter. V is
/// - Ewa: h^2 J J^T + I;
/// - Circular: lambda I, lambda the larger eigenvalue of that (Figure 8, third row);
/// - Unfiltered: h^2 J J^T (Figure 8, bottom); a kernel that is less than a pixel wide is moved to
///   the middle of its pixel, so that no point is lost.
/// Nothing if the point's area is below kMinArea pixels, or the kernel is not finite.
/// `filter` is not SourceSpace. `radius` h > 0.
[[nodiscard]] std::optional<ScreenKernel> screen_kernel(const TangentMapping& mapping,
                                                        double radius, EwaFilter filter,
                                                        double cutoff);
inline constexpr double kMinArea = 1e-12;

/// The kernel over the tangent plane: each pixel is mapped back through the inverse of the affine
/// mapping and looked up in a Gaussian with the variance h^2 I + J^-1 J^-T.
struct SourceKernel {
  glm::dvec2 centre{0.0};
  glm::dmat2 to_plane{1.0};  ///< J^-1
  glm::dvec3 form{0.0};      ///< as ScreenKernel::form, of plane coordinates
  double peak = 0.0;         ///< h^2 / (2 pi sqrt |h^2 I + J^-1 J^-T|)
  glm::dvec2 extent{0.0};

  [[nodiscard]] double exponent(glm::dvec2 pixel) const {
    const glm::dvec2 u = to_plane * (pixel - centre);
    return (form.x * u.x + form.y * u.y) * u.x + form.z * u.y * u.y;
  }
};

/// The kernel of Eq. (8), times h^2. Made from the variance in the plane alone, so that it can be
/// held against screen_kernel(). Nothing in the same cases.
[[nodiscard]] std::optional<SourceKernel> source_kernel(const TangentMapping& mapping,
                                                        double radius, double cutoff);

}  // namespace relief::ewa
