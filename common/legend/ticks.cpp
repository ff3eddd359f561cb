#include "common/legend/ticks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace relief {
namespace {

/// Numbers from here on are written with an exponent, as are steps below kSmallest.
constexpr double kLargest = 1e12;
constexpr double kSmallest = 1e-6;

/// A step of 1, 2 or 5 times a power of ten.
struct Step {
  int digit = 1;
  int power = 0;

  [[nodiscard]] double size() const { return digit * std::pow(10.0, power); }
  /// Returns the k-th multiple, rounded once: 3 * 0.1 is 0.3.
  [[nodiscard]] double multiple(double k) const {
    return power < 0 ? k * digit / std::pow(10.0, -power) : k * size();
  }
};

/// Returns the smallest step of which at most `most` multiples lie within the range.
Step step_for(double low, double high, int most) {
  const auto fits = [&](const Step& step) {
    const double size = step.size();
    return std::floor(high / size) - std::ceil(low / size) + 1.0 <= most;
  };
  const int power = static_cast<int>(std::floor(std::log10((high - low) / most)));
  for (const Step step :
       {Step{1, power}, Step{2, power}, Step{5, power}, Step{1, power + 1}, Step{2, power + 1}}) {
    if (fits(step)) return step;
  }
  return {5, power + 1};
}

std::string text_of(double value, const Step& step, double largest) {
  if (largest < kLargest && (step.size() >= kSmallest || value == 0.0))
    return fmt::format("{:.{}f}", value, std::max(-step.power, 0));
  const int digits = static_cast<int>(std::floor(std::log10(largest))) - step.power;
  return fmt::format("{:.{}e}", value, std::clamp(digits, 0, 16));
}

}  // namespace

std::vector<Tick> find_ticks(double low, double high, int most) {
  const double largest = std::max(std::abs(low), std::abs(high));
  // 15 digits: more are beyond double precision.
  if (!(high - low > 1e-15 * largest) || !std::isfinite(high - low))
    return {{low, fmt::format("{:.6g}", low)}};
  const Step step = step_for(low, high, most);
  std::vector<Tick> ticks;
  const double first = std::ceil(low / step.size());
  for (int k = 0; k < most; ++k) {
    // Adding zero makes 0 of -0.
    const double value = step.multiple(first + k) + 0.0;
    if (value > high) break;
    ticks.push_back({std::max(value, low), text_of(value, step, largest)});
  }
  return ticks;
}

}  // namespace relief
