// Clip lines of a splat as the image shows them ([Ivo 2011], section V).
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/mat2x2.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <numbers>
#include <span>

#include "renderer/clip/clip_partners.h"
#include "renderer/engines/ewa/resampling_filter.h"

namespace relief::ewa {

/// A line that clips a splat, in the image.
struct ImageLine {
  /// Of a pixel's offset from the kernel's centre: along x, along y, at the centre. Above 0 beyond
  /// the line, in standard deviations of what the pixel sees of the splat.
  glm::dvec3 beyond{0.0};
  bool ends_group = true;  ///< as ClipLine::ends_group

  /// The share of what a pixel sees of the splat that lies before the line.
  [[nodiscard]] double kept(glm::dvec2 offset) const {
    const double distance = beyond.x * offset.x + beyond.y * offset.y + beyond.z;
    if (distance < -kFar) return 1.0;
    if (distance > kFar) return 0.0;
    return 0.5 * std::erfc(distance / std::numbers::sqrt2);
  }
  static constexpr double kFar = 4.0;  ///< where that is less than 1e-4 off 0 or 1
};

/// Where a ray meets a splat's plane, as a function of its pixel's offset from the splat's centre:
/// above 0 beyond the line, below 0 before it. The mapping from a plane to the image keeps lines
/// straight, so that it is linear, and exact in perspective, where the kernel's mapping is affine.
/// `point`, `normal` (unit) and the line's `direction` (unit, in the plane) in the camera frame of
/// resampling_filter.h; `offset`: of the line, as ClipLine::offset.
[[nodiscard]] glm::dvec3 beyond_line(const PixelMapping& mapping, glm::dvec3 point,
                                     glm::dvec3 normal, glm::dvec3 direction, double offset);

/// What a pixel at x sees of a splat, whose Gaussian has the variance V in the image, through a
/// filter of variance b I: G_V times G_b about x, which is a Gaussian of variance b M about M x, M
/// = V (V + b I)^-1. So the share of it before a line is the share of the pixel before the line for
/// a large splat, and that of the splat for one smaller than a pixel. b is the variance of a
/// pixel's square, kPixelVariance: with that of the low-pass filter, 1, the silhouette of a cube of
/// 20 x 20 points a face moved out by 0.8 pixels (PSNR of its coverage against a ray-traced cube
/// 27.5 dB, so 32.5 dB, a hard cut 33.3 dB; measured when what is kept of kernels, not its share,
/// was the coverage).
struct SeenSplat {
  glm::dmat2 mean{1.0};  ///< M
  double filter = 0.0;   ///< b; 0: without a filter
};
inline constexpr double kPixelVariance = 1.0 / 12.0;
[[nodiscard]] SeenSplat seen_splat(const TangentMapping& plane, double radius, EwaFilter filter);

/// The line `beyond` (of any scale above 0) for what pixels see of a splat.
[[nodiscard]] ImageLine image_line(glm::dvec3 beyond, const SeenSplat& seen, bool ends_group);

/// What a pixel sees of a splat before its lines.
struct KeptShare {
  double share = 1.0;
  glm::dvec2 beyond{0.0};  ///< across the line that cuts off the rest, away from what is kept
};

/// The share of what a pixel sees of a splat that no group of lines clips. A group clips what lies
/// beyond all of its lines.
[[nodiscard]] inline KeptShare kept_share(std::span<const ImageLine> lines, glm::dvec2 offset) {
  KeptShare kept;
  KeptShare of_group{0.0, {}};
  for (const ImageLine& line : lines) {
    const double share = line.kept(offset);
    if (share > of_group.share) of_group = {share, glm::dvec2(line.beyond)};
    if (!line.ends_group) continue;
    if (of_group.share < kept.share) kept = of_group;
    of_group = {0.0, {}};
  }
  return kept;
}

/// The share of a splat's Gaussian (deviation `radius`) that its lines keep, at least kLeastKept: a
/// splat stands for as much of the surface as before, so that its kernel grows by what it loses.
/// Without that the sum of kernels falls to half at an edge, where coverage begins to end.
[[nodiscard]] double kept_mass(std::span<const ClipLine> lines, double radius);
inline constexpr double kLeastKept = 1.0 / 3.0;

}  // namespace relief::ewa
