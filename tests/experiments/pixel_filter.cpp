#include "tests/experiments/pixel_filter.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <vector>

namespace relief::experiment {
namespace {

constexpr std::size_t kReach = 4;  // pixels beside a pixel: exp(-4^2 / 2) is 0.0003

/// The weights of the samples from kReach pixels before a pixel to kReach after it; their sum is 1.
std::vector<double> gaussian_weights(std::uint32_t per_side) {
  std::vector<double> weights((2 * kReach + 1) * per_side);
  const double middle = 0.5 * static_cast<double>(weights.size());
  double sum = 0.0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const double pixels = (static_cast<double>(i) + 0.5 - middle) / per_side;
    weights[i] = std::exp(-0.5 * pixels * pixels);
    sum += weights[i];
  }
  for (double& weight : weights) weight /= sum;
  return weights;
}

std::vector<double> box_weights(std::uint32_t per_side) {
  std::vector<double> weights((2 * kReach + 1) * per_side, 0.0);
  for (std::size_t i = 0; i < per_side; ++i) weights[kReach * per_side + i] = 1.0 / per_side;
  return weights;
}

/// A weighted sum of values that lie `stride` apart.
glm::dvec4 weighted(const std::vector<double>& weights, const glm::dvec4* values,
                    std::size_t stride) {
  glm::dvec4 sum(0.0);
  for (std::size_t i = 0; i < weights.size(); ++i) sum += weights[i] * values[i * stride];
  return sum;
}

/// Rows of samples that were filtered along the row: `side` values each.
struct FilteredRows {
  std::vector<double> weights;
  std::vector<glm::dvec4> values;
};

Truth filter_columns(const FilteredRows& rows, std::uint32_t side, std::uint32_t per_side) {
  std::vector<glm::dvec4> pixels(std::size_t{side} * side);
  tbb::parallel_for(std::size_t{0}, std::size_t{side}, [&](std::size_t y) {
    for (std::size_t x = 0; x < side; ++x)
      pixels[y * side + x] =
          weighted(rows.weights, rows.values.data() + y * per_side * side + x, side);
  });
  Truth truth;
  truth.image = {side, side, {}};
  constexpr const char* kNames[] = {"R", "G", "B"};
  for (glm::length_t c = 0; c < 3; ++c) {
    Channel channel{kNames[c], ChannelType::Float, {}};
    for (const glm::dvec4& pixel : pixels) channel.values.push_back(static_cast<float>(pixel[c]));
    truth.image.channels.push_back(std::move(channel));
  }
  for (const glm::dvec4& pixel : pixels) truth.coverage.push_back(pixel.a);
  return truth;
}

}  // namespace

Mask Truth::covered() const {
  // Weights that add up to 1 do so within rounding; the Gaussian's outermost sample of a row weighs
  // 1e-6 with 32 a side.
  constexpr double kWhole = 1.0 - 1e-9;
  Mask mask;
  for (const double share : coverage) mask.push_back(share >= kWhole ? 1 : 0);
  return mask;
}

Truths filter_samples(std::uint32_t side, std::uint32_t per_side, const SampleAt& sample) {
  const std::size_t fine = (side + 2 * kReach) * per_side;
  FilteredRows gaussian{gaussian_weights(per_side), std::vector<glm::dvec4>(fine * side)};
  FilteredRows box{box_weights(per_side), std::vector<glm::dvec4>(fine * side)};
  const auto place = [&](std::size_t i) {
    return (static_cast<double>(i) + 0.5) / per_side - double{kReach};
  };
  tbb::parallel_for(std::size_t{0}, fine, [&](std::size_t y) {
    std::vector<glm::dvec4> row(fine);
    for (std::size_t x = 0; x < fine; ++x) row[x] = sample({place(x), place(y)});
    for (std::size_t i = 0; i < side; ++i) {
      gaussian.values[y * side + i] = weighted(gaussian.weights, row.data() + i * per_side, 1);
      box.values[y * side + i] = weighted(box.weights, row.data() + i * per_side, 1);
    }
  });
  return {filter_columns(gaussian, side, per_side), filter_columns(box, side, per_side)};
}

}  // namespace relief::experiment
