#include "preprocess/raster/height_steps.h"

#include <algorithm>
#include <cmath>

namespace relief {
namespace {

constexpr double kPowers[] = {1.0, 10.0, 100.0, 1e3, 1e4, 1e5};

/// Half a unit in the last place of a single-precision number of this size.
double single_precision(double value) {
  return std::abs(value) * 6e-8;
}

bool is_whole(double value, double power) {
  const double scaled = value * power;
  const double slack = single_precision(scaled) + 1e-9;
  // Numbers of which single precision tells no such steps are not described by them.
  return slack < 0.05 && std::abs(scaled - std::round(scaled)) <= slack;
}

}  // namespace

void HeightSteps::add(std::span<const double> heights) {
  for (const double value : heights) {
    if (!std::isfinite(value)) continue;
    low_ = std::min(low_, value);
    high_ = std::max(high_, value);
    while (decimals_ < kDecimals && !is_whole(value, kPowers[decimals_])) ++decimals_;
  }
}

double HeightSteps::decimal_step() const {
  return decimals_ < kDecimals ? 1.0 / kPowers[decimals_] : 0.0;
}

}  // namespace relief
