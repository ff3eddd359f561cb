#include "preprocess/resample/spacing/patch_spacing.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>

#include "preprocess/partition/spacing_range.h"

namespace relief {
namespace {

// Scans of scanners, thinned so that their density falls along an axis: the samples of a third as
// many points at the sparse end (a ratio of 1.8 to 2.1) are as far off either way, of a tenth (2.2
// to 2.9) a tenth to a quarter less with spacings that follow. Points at random have 1.5.
constexpr double kUnevenRatio = 2.5;

// The finest spacing of patches is that of the densest twentieth of the points: a smaller share
// could be a few points that are close by chance.
constexpr double kFinestShare = 0.05;
// A few points that lie far apart may be stray: a wide grid would make a large sheet of them.
constexpr std::size_t kFewPoints = 64;
constexpr double kWidestOfFewPoints = 2.0;
// Sparse points that are rougher than this, in spacings of the model, are no smooth surface: a
// coarse grid would make large blades of trees.
constexpr double kRough = 0.25;

/// Returns the value below which this share of the values lie.
double quantile(std::vector<float>& values, double share) {
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// The local spacings of the points of all regions that have so many.
std::vector<float> spacings_of(const SurfaceSamples& samples, const std::vector<Region>& regions,
                               std::size_t fewest) {
  std::vector<float> spacings;
  for (const Region& region : regions) {
    if (region.points.size() < fewest) continue;
    for (const std::uint32_t i : region.points) spacings.push_back(samples.spacing[i]);
  }
  return spacings;
}

}  // namespace

bool is_uneven(const SurfaceSamples& samples, const std::vector<Region>& regions) {
  return spacing_range(spacings_of(samples, regions, kFewPoints)).ratio() >= kUnevenRatio;
}

std::vector<double> spacing_factors(const SurfaceSamples& samples,
                                    const std::vector<Region>& regions) {
  std::vector<float> all = spacings_of(samples, regions, 1);
  std::vector<double> factors(regions.size(), 1.0);
  if (all.empty()) return factors;
  const double usual = quantile(all, 0.5);
  const double finest = quantile(all, kFinestShare) / usual;
  tbb::parallel_for(std::size_t{0}, regions.size(), [&](std::size_t r) {
    double factor = double{median_of(samples.spacing, regions[r])} / usual;
    if (factor > 1.0) {
      const double roughness = double{median_of(samples.roughness, regions[r])} / (kRough * usual);
      factor = std::max(1.0, factor / std::max(1.0, roughness));
      if (regions[r].points.size() < kFewPoints) factor = std::min(factor, kWidestOfFewPoints);
    }
    factors[r] = std::max(finest, factor);
  });
  return factors;
}

}  // namespace relief
