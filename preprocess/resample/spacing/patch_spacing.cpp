#include "preprocess/resample/spacing/patch_spacing.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace relief {
namespace {

// The finest spacing of patches is that of the densest twentieth of the points: a smaller share
// could be a few points that are close by chance.
constexpr double kFinestShare = 0.05;

/// Returns the value below which this share of the values lie.
double quantile(std::vector<float>& values, double share) {
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace

std::vector<double> spacing_factors(const SurfaceSamples& samples,
                                    const std::vector<Region>& regions) {
  std::vector<float> all;
  for (const Region& region : regions) {
    for (const std::uint32_t i : region.points) all.push_back(samples.spacing[i]);
  }
  std::vector<double> factors(regions.size(), 1.0);
  if (all.empty()) return factors;
  const double usual = quantile(all, 0.5);
  const double finest = quantile(all, kFinestShare) / usual;
  tbb::parallel_for(std::size_t{0}, regions.size(), [&](std::size_t r) {
    std::vector<float> own;
    for (const std::uint32_t i : regions[r].points) own.push_back(samples.spacing[i]);
    factors[r] = std::clamp(quantile(own, 0.5) / usual, finest, kWidestSpacingRatio * finest);
  });
  return factors;
}

}  // namespace relief
