#include "preprocess/gaussians/gaussian_collector.h"

#include <algorithm>
#include <cmath>
#include <glm/exponential.hpp>
#include <limits>
#include <utility>

namespace relief {
namespace {

/// Of a quaternion. Shorter ones have lost digits when their square is taken.
constexpr double kLeastLength = std::numeric_limits<float>::min();

bool is_finite(glm::vec3 v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace

GaussianCollector::GaussianCollector(std::size_t count, int degree, AxisSigns axes)
    : stride_(harmonics_of(degree)),
      axes_(axes),
      harmonics_signs_(harmonics_signs(axes)),
      is_bad_(count) {
  cloud_.degree = degree;
  cloud_.centres.resize(count);
  cloud_.scales.resize(count);
  cloud_.rotations.resize(count);
  cloud_.opacities.resize(count);
  cloud_.harmonics.resize(count * stride_);
}

void GaussianCollector::set(std::size_t index, const FileGaussian& gaussian) {
  const glm::vec3 centre = axes_ * glm::vec3(gaussian.centre);
  const glm::vec3 scales(glm::exp(gaussian.log_scales));
  const double length = glm::length(gaussian.rotation);
  bool is_good = is_finite(centre) && is_finite(scales) && scales.x > 0.0F && scales.y > 0.0F &&
                 scales.z > 0.0F && std::isfinite(length) && length >= kLeastLength &&
                 gaussian.opacity >= 0.0 && gaussian.opacity <= 1.0;
  const std::span<glm::vec3> coefficients = harmonics(index);
  for (std::size_t c = 0; c < stride_; ++c) {
    is_good = is_good && is_finite(coefficients[c]);
    coefficients[c] *= harmonics_signs_[c];
  }
  is_bad_[index] = is_good ? 0 : 1;
  if (!is_good) return;
  cloud_.centres[index] = centre;
  cloud_.scales[index] = scales;
  cloud_.rotations[index] = glm::quat(turned(gaussian.rotation / length, axes_));
  cloud_.opacities[index] = static_cast<float>(gaussian.opacity);
}

void GaussianCollector::drop() {
  std::size_t kept = 0;
  for (std::size_t k = 0; k < is_bad_.size(); ++k) {
    if (is_bad_[k] != 0) continue;
    cloud_.centres[kept] = cloud_.centres[k];
    cloud_.scales[kept] = cloud_.scales[k];
    cloud_.rotations[kept] = cloud_.rotations[k];
    cloud_.opacities[kept] = cloud_.opacities[k];
    if (kept != k) std::ranges::copy(harmonics(k), harmonics(kept).begin());
    ++kept;
  }
  cloud_.centres.resize(kept);
  cloud_.scales.resize(kept);
  cloud_.rotations.resize(kept);
  cloud_.opacities.resize(kept);
  cloud_.harmonics.resize(kept * stride_);
}

Result<GaussianCloud> GaussianCollector::finish(const Source& source) && {
  const std::size_t count = is_bad_.size();
  if (count == 0) return make_error("{}: holds no Gaussians", source.name);
  const auto bad = static_cast<std::size_t>(std::ranges::count(is_bad_, std::uint8_t{1}));
  if (bad == count) {
    return make_error(
        "{}: none of its {} Gaussians can be drawn: each has a number that is not finite, a scale "
        "of 0 or a rotation of length 0",
        source.name, count);
  }
  if (bad > 0) {
    drop();
    source.progress.note(fmt::format(
        "{}: {} of {} Gaussians are dropped: they have a number that is not finite, a scale of 0 "
        "or a rotation of length 0",
        source.name, bad, count));
  }
  return std::move(cloud_);
}

}  // namespace relief
