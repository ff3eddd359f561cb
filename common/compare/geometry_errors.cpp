#include "common/compare/geometry_errors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec3.hpp>
#include <limits>

#include "common/compare/statistics.h"

namespace relief {
namespace {

/// One kind of channels in both images.
template <std::size_t N>
struct Channels {
  std::array<const std::vector<float>*, N> test;
  std::array<const std::vector<float>*, N> reference;

  [[nodiscard]] bool finite(std::size_t k) const {
    const auto is_finite = [k](const std::vector<float>* values) {
      return std::isfinite((*values)[k]);
    };
    return std::all_of(test.begin(), test.end(), is_finite) &&
           std::all_of(reference.begin(), reference.end(), is_finite);
  }
};

template <std::size_t N>
Result<Channels<N>> find_channels(const Image& test, const Image& reference,
                                  const std::array<const char*, N>& names) {
  Channels<N> found;
  for (std::size_t i = 0; i < N; ++i) {
    const Channel* const a = test.find(names[i]);
    const Channel* const b = reference.find(names[i]);
    if (a == nullptr) return make_error("the image under test has no channel {}", names[i]);
    if (b == nullptr) return make_error("the reference has no channel {}", names[i]);
    found.test[i] = &a->values;
    found.reference[i] = &b->values;
  }
  return found;
}

/// Calls `look(k)` for each pixel of the mask, in order.
template <class Look>
void for_each_pixel(const Image& image, const std::vector<std::uint8_t>* mask, const Look& look) {
  const std::size_t pixels = std::size_t{image.width} * image.height;
  for (std::size_t k = 0; k < pixels; ++k) {
    if (mask == nullptr || (*mask)[k] != 0) look(k);
  }
}

glm::dvec3 normal_at(const std::array<const std::vector<float>*, 3>& channels, std::size_t k) {
  return {(*channels[0])[k], (*channels[1])[k], (*channels[2])[k]};
}

/// By arc tangent, which does not depend on lengths: an arc cosine loses angles below 1e-8 to
/// rounding, and those whose cosine is rounded beyond 1 to NaN.
double angle_deg(const glm::dvec3& a, const glm::dvec3& b) {
  return glm::degrees(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
}

/// The range of included values.
struct ValueRange {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void include(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  [[nodiscard]] double size() const { return high - low; }
};

}  // namespace

Result<NormalErrors> measure_normals(const Image& test, const Image& reference,
                                     const std::vector<std::uint8_t>* mask) {
  // Below this length, half-float rounding turns a normal noticeably; no engine writes
  // shorter normals.
  constexpr double kShortest = 1e-3;
  const auto channels = find_channels<3>(test, reference, {"N.X", "N.Y", "N.Z"});
  if (!channels) return channels.error();
  SquaredErrors angles;
  SquaredErrors components;
  std::vector<float> all;
  for_each_pixel(reference, mask, [&](std::size_t k) {
    if (!channels->finite(k)) return;
    const glm::dvec3 a = normal_at(channels->test, k);
    const glm::dvec3 b = normal_at(channels->reference, k);
    if (glm::length(a) < kShortest || glm::length(b) < kShortest) return;
    const double angle = angle_deg(a, b);
    angles.add(angle);
    all.push_back(static_cast<float>(angle));
    for (int i = 0; i < 3; ++i) components.add(a[i] - b[i]);
  });
  if (all.empty()) return make_error("no pixel is covered, with a normal, in both images");
  return NormalErrors{angles.rms(), percentile(all, 0.99), psnr_db(components.rms(), 2.0)};
}

Result<DepthErrors> measure_depth(const Image& test, const Image& reference,
                                  const std::vector<std::uint8_t>* mask) {
  const auto channels = find_channels<1>(test, reference, {"Z"});
  if (!channels) return channels.error();
  SquaredErrors relative;
  SquaredErrors absolute;
  ValueRange range;
  std::vector<float> all;
  for_each_pixel(reference, mask, [&](std::size_t k) {
    const double a = (*channels->test[0])[k];
    const double b = (*channels->reference[0])[k];
    if (!channels->finite(k) || !(b > 0.0)) return;
    const double error = std::abs(a - b) / b;
    relative.add(error);
    absolute.add(a - b);
    range.include(b);
    // Beyond float only if one depth is almost 0 and another is not.
    all.push_back(static_cast<float>(
        std::min(error, static_cast<double>(std::numeric_limits<float>::max()))));
  });
  if (all.empty()) return make_error("no pixel is covered, with a depth, in both images");
  DepthErrors errors{relative.rms(), percentile(all, 0.99), std::nullopt};
  if (range.size() > 0.0) errors.psnr_db = psnr_db(absolute.rms(), range.size());
  return errors;
}

Result<double> measure_uv_psnr_db(const Image& test, const Image& reference,
                                  const std::vector<std::uint8_t>* mask) {
  const auto channels = find_channels<2>(test, reference, {"UV.U", "UV.V"});
  if (!channels) return channels.error();
  const auto patches = find_channels<1>(test, reference, {"patch"});
  if (!patches) return patches.error();
  SquaredErrors errors;
  ValueRange range;
  for_each_pixel(reference, mask, [&](std::size_t k) {
    const float patch = (*patches->reference[0])[k];
    if (!channels->finite(k) || patch == 0.0F || patch != (*patches->test[0])[k]) return;
    for (std::size_t i = 0; i < 2; ++i) {
      const double b = (*channels->reference[i])[k];
      errors.add((*channels->test[i])[k] - b);
      range.include(b);
    }
  });
  if (errors.count == 0) return make_error("no pixel shows the same patch in both images");
  if (range.size() == 0.0) return make_error("the reference has only one grid coordinate");
  return psnr_db(errors.rms(), range.size());
}

Result<double> measure_alpha_psnr_db(const Image& test, const Image& reference) {
  const auto channels = find_channels<1>(test, reference, {"A"});
  if (!channels) return channels.error();
  // Compared in this order NaN becomes 0.
  const auto clamped = [](float a) { return a > 0.0F ? std::min(a, 1.0F) : 0.0F; };
  SquaredErrors errors;
  for_each_pixel(reference, nullptr, [&](std::size_t k) {
    errors.add(double{clamped((*channels->test[0])[k])} -
               double{clamped((*channels->reference[0])[k])});
  });
  return psnr_db(errors.rms(), 1.0);
}

}  // namespace relief
