#include "common/scalars/quantise.h"

#include <algorithm>
#include <cmath>

namespace relief {
namespace {

/// The range ends this many times the width of the middle 96 % beyond them.
constexpr double kTailWidths = 16.0;
/// Larger numbers count as this: the width of a range of them would be infinite.
constexpr double kLargest = 4e307;
constexpr std::size_t kLowPercent = 2;
constexpr std::size_t kHighPercent = 98;

bool are_whole(std::span<const double> values) {
  return std::ranges::all_of(values,
                             [](double v) { return !std::isfinite(v) || v == std::floor(v); });
}

}  // namespace

std::optional<Quantiles> find_quantiles(std::span<const double> values) {
  std::vector<double> sorted;
  sorted.reserve(values.size());
  std::ranges::copy_if(values, std::back_inserter(sorted),
                       [](double v) { return std::isfinite(v); });
  if (sorted.empty()) return std::nullopt;
  std::ranges::sort(sorted);
  Quantiles quantiles{};
  for (std::size_t k = 0; k < quantiles.size(); ++k)
    quantiles[k] = sorted[k * (sorted.size() - 1) / (quantiles.size() - 1)];
  return quantiles;
}

double at_percent(const Quantiles& quantiles, double percent) {
  const double at = std::clamp(percent, 0.0, 100.0);
  const auto below = std::min(static_cast<std::size_t>(at), quantiles.size() - 2);
  return std::lerp(quantiles[below], quantiles[below + 1], at - static_cast<double>(below));
}

std::optional<ScalarInfo> describe_scalar(const PointScalar& scalar) {
  const auto quantiles = find_quantiles(scalar.values);
  if (!quantiles) return std::nullopt;
  return describe_scalar(scalar.name, scalar.is_label, are_whole(scalar.values), *quantiles);
}

ScalarInfo describe_scalar(const std::string& name, bool is_label, bool are_whole,
                           const Quantiles& quantiles) {
  double low = quantiles.front();
  double high = quantiles.back();
  ScalarInfo info{name, is_label, low, 1.0, {}};
  if (!are_whole || high - low > kMaxScalarCode) {
    const double width = quantiles[kHighPercent] - quantiles[kLowPercent];
    if (width > 0.0) {
      low = std::max(low, quantiles[kLowPercent] - kTailWidths * width);
      high = std::min(high, quantiles[kHighPercent] + kTailWidths * width);
    }
    low = std::clamp(low, -kLargest, kLargest);
    high = std::clamp(high, -kLargest, kLargest);
    info.offset = low;
    const double step = (high - low) / kMaxScalarCode;
    if (std::isnormal(step)) info.step = step;
  }
  std::ranges::transform(quantiles, info.quantiles.begin(),
                         [&info](double value) { return code_of(info, value); });
  return info;
}

std::uint16_t code_of(const ScalarInfo& scalar, double value) {
  if (std::isnan(value)) return kNoScalar;
  const double code = std::round(value / scalar.step - scalar.offset / scalar.step);
  return static_cast<std::uint16_t>(std::clamp(code, 0.0, double{kMaxScalarCode}));
}

}  // namespace relief
