#include "cli/plot/plot_axis.h"

#include <algorithm>
#include <cmath>

namespace relief::cli {

Axis axis_of(const std::vector<double>& values, double min_width) {
  if (values.empty()) return {0.0, min_width};
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const double width = std::max(1.16 * (*high - *low), min_width);
  const double middle = 0.5 * (*low + *high);
  return {middle - 0.5 * width, middle + 0.5 * width};
}

std::vector<double> logarithmic_ticks(const Axis& axis) {
  std::vector<double> ticks;
  for (auto power = static_cast<int>(std::floor(axis.min)); power <= axis.max; ++power) {
    for (const double digit : {1.0, 2.0, 5.0}) {
      const double tick = digit * std::pow(10.0, power);
      const double fraction = axis.fraction(std::log10(tick));
      if (fraction >= 0.0 && fraction <= 1.0) ticks.push_back(tick);
    }
  }
  return ticks;
}

std::vector<double> linear_ticks(const Axis& axis) {
  const double rough = (axis.max - axis.min) / 8.0;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  double step = 10.0 * power;
  for (const double digit : {5.0, 2.0, 1.0}) {
    if (digit * power >= rough) step = digit * power;
  }
  std::vector<double> ticks;
  for (double k = std::ceil(axis.min / step); k * step <= axis.max; k += 1.0)
    ticks.push_back(k * step);
  return ticks;
}

}  // namespace relief::cli
