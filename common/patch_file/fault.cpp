#include "common/patch_file/fault.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/matrix.hpp>

#include "common/is_finite.h"

namespace relief {
namespace {

/// Tolerance of orthonormal axes: the rounding of a double rotation is near 1e-16, that of a matrix
/// once stored as floats near 1e-7.
constexpr double kAxesTolerance = 1e-6;

bool is_positive(double value) {
  return std::isfinite(value) && value > 0.0;
}

bool is_rotation(const glm::dmat3& axes) {
  const glm::dmat3 product = glm::transpose(axes) * axes;
  for (glm::length_t c = 0; c < 3; ++c) {
    for (glm::length_t r = 0; r < 3; ++r) {
      // Negated so that NaN is found too.
      if (!(std::abs(product[c][r] - (c == r ? 1.0 : 0.0)) <= kAxesTolerance)) return false;
    }
  }
  return glm::determinant(axes) > 0.0;
}

}  // namespace

std::string find_fault(const PatchSummary& patch) {
  if (!is_finite(patch.origin)) return "its origin is not finite";
  if (!is_rotation(patch.axes)) return "its axes are not a rotation";
  if (!is_positive(patch.spacing)) return "its spacing is not above 0";
  if (!is_positive(patch.height_step)) return "its height step is not above 0";
  // Heights are 65534 steps at most: beyond these ratios a patch is a plane or a needle, and sums
  // of its slopes leave double precision.
  const double steps_per_cell = patch.spacing / patch.height_step;
  if (!(steps_per_cell >= 1e-6 && steps_per_cell <= 1e9)) {
    return "its height step does not go with its spacing";
  }
  if (patch.width == 0 || patch.height == 0 || patch.width > kMaxPatchSide ||
      patch.height > kMaxPatchSide) {
    return fmt::format("its size {}x{} is not within 1x1 to {}x{} nodes", patch.width, patch.height,
                       kMaxPatchSide, kMaxPatchSide);
  }
  if (patch.samples > std::uint64_t{patch.width} * patch.height) {
    return fmt::format("it has {} samples on {}x{} nodes", patch.samples, patch.width,
                       patch.height);
  }
  if (patch.min_height > patch.max_height || patch.max_height > kMaxHeightRange) {
    return fmt::format("its heights {} to {} are not within 0 to {}", patch.min_height,
                       patch.max_height, kMaxHeightRange);
  }
  if (!(patch.cone_cosine >= -1.0F && patch.cone_cosine <= 1.0F)) {
    return "its normal cone is none";
  }
  return {};
}

std::string find_fault(double spacing, const Bounds& bounds, double bounding_radius) {
  if (!std::isfinite(spacing) || spacing < 0.0) return "its spacing is negative or not finite";
  if (!std::isfinite(bounding_radius) || bounding_radius < 0.0) {
    return "its bounding radius is negative or not finite";
  }
  if (!is_finite(bounds.min) || !is_finite(bounds.max)) return "its bounds are not finite";
  if (!bounds.empty() && (bounds.min.y > bounds.max.y || bounds.min.z > bounds.max.z)) {
    return "its bounds are inside out";
  }
  return {};
}

}  // namespace relief
