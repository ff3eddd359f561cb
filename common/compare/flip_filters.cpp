#include "common/compare/flip_filters.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace relief {
namespace {

constexpr double kPi = glm::pi<double>();

/// 2020, Table 1: a sqrt(pi / b) exp(-pi^2 x^2 / b), x in degrees.
struct ContrastGaussian {
  double a = 1.0;
  double b = 1.0;
};
constexpr ContrastGaussian kLuminance{1.0, 0.0047};
constexpr ContrastGaussian kRedGreen{1.0, 0.0053};
constexpr ContrastGaussian kBlueYellow{34.1, 0.04};
constexpr ContrastGaussian kBlueYellowWide{13.5, 0.025};

/// 2020, section 4.2.1: the width of the edges that the eye sees best, in degrees.
constexpr double kFeatureWidth = 0.082;

template <class Weight>
std::vector<double> sample(std::size_t radius, const Weight& weight) {
  std::vector<double> weights;
  for (std::size_t i = 0; i <= 2 * radius; ++i) {
    weights.push_back(weight(static_cast<double>(i) - static_cast<double>(radius)));
  }
  return weights;
}

double sum(const std::vector<double>& weights) {
  double total = 0.0;
  for (const double weight : weights) total += weight;
  return total;
}

Taps scaled(const std::vector<double>& weights, double factor) {
  Taps taps;
  for (const double weight : weights) taps.push_back(static_cast<float>(weight * factor));
  return taps;
}

/// Scales positive and negative weights to sums of 1 and -1.
Taps balanced(const std::vector<double>& weights) {
  double positive = 0.0;
  double negative = 0.0;
  for (const double weight : weights) (weight > 0.0 ? positive : negative) += std::abs(weight);
  Taps taps;
  for (const double weight : weights) {
    taps.push_back(static_cast<float>(weight / (weight > 0.0 ? positive : negative)));
  }
  return taps;
}

/// The factor of a two-dimensional Gaussian along one axis, so that two of them make up its height.
std::vector<double> contrast_weights(const ContrastGaussian& gaussian, double pixels_per_degree,
                                     std::size_t radius) {
  const double height = std::sqrt(gaussian.a * std::sqrt(kPi / gaussian.b));
  return sample(radius, [&](double pixel) {
    const double x = pixel / pixels_per_degree;
    return height * std::exp(-kPi * kPi * x * x / gaussian.b);
  });
}

}  // namespace

FlipFilters make_flip_filters(double pixels_per_degree) {
  FlipFilters filters;
  // Three standard deviations of the widest Gaussian, whose variance is b / (2 pi^2).
  const double widest = std::max(kBlueYellow.b, kBlueYellowWide.b);
  filters.contrast_radius = static_cast<std::size_t>(
      std::ceil(3.0 * std::sqrt(widest / (2.0 * kPi * kPi)) * pixels_per_degree));
  const auto contrast = [&](const ContrastGaussian& gaussian) {
    return contrast_weights(gaussian, pixels_per_degree, filters.contrast_radius);
  };
  const auto y = contrast(kLuminance);
  const auto cx = contrast(kRedGreen);
  const auto cz = contrast(kBlueYellow);
  const auto cz_wide = contrast(kBlueYellowWide);
  filters.luminance = scaled(y, 1.0 / sum(y));
  filters.red_green = scaled(cx, 1.0 / sum(cx));
  const double both = 1.0 / std::hypot(sum(cz), sum(cz_wide));
  filters.blue_yellow = scaled(cz, both);
  filters.blue_yellow_wide = scaled(cz_wide, both);

  const double deviation = 0.5 * kFeatureWidth * pixels_per_degree;
  filters.feature_radius = static_cast<std::size_t>(std::ceil(3.0 * deviation));
  const auto gaussian = [deviation](double x) {
    return std::exp(-0.5 * x * x / (deviation * deviation));
  };
  const auto smooth = sample(filters.feature_radius, gaussian);
  filters.smooth = scaled(smooth, 1.0 / sum(smooth));
  filters.edge =
      balanced(sample(filters.feature_radius, [&](double x) { return -x * gaussian(x); }));
  filters.point = balanced(sample(filters.feature_radius, [&](double x) {
    return (x * x / (deviation * deviation) - 1.0) * gaussian(x);
  }));
  return filters;
}

void filter_along_row(const float* in, const Taps& taps, std::size_t count, float* out) {
  filter_across_rows(in, 1, taps, count, out);
}

void filter_across_rows(const float* first, std::size_t stride, const Taps& taps, std::size_t count,
                        float* out) {
  std::fill(out, out + count, 0.0F);
  // Four taps at a time over the whole row: the compiler makes vectors of the inner loop, and `out`
  // is read and written a fourth as often as with one.
  std::size_t i = 0;
  for (; i + 4 <= taps.size(); i += 4) {
    const float* const in = first + i * stride;
    const float w[4] = {taps[i], taps[i + 1], taps[i + 2], taps[i + 3]};
    for (std::size_t x = 0; x < count; ++x) {
      out[x] += (w[0] * in[x] + w[1] * in[x + stride]) +
                (w[2] * in[x + 2 * stride] + w[3] * in[x + 3 * stride]);
    }
  }
  for (; i < taps.size(); ++i) {
    const float* const in = first + i * stride;
    for (std::size_t x = 0; x < count; ++x) out[x] += taps[i] * in[x];
  }
}

}  // namespace relief
