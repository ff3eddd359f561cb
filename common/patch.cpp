#include "common/patch.h"

#include <algorithm>
#include <iterator>

#include "common/extremes.h"

namespace relief {

void set_extent(PatchModel& model, const std::vector<glm::dvec3>& positions) {
  model.bounds = bounds_of(positions);
  model.bounding_radius = bounding_radius(positions, model.bounds);
  model.extremes = extreme_points(positions, model.bounds);
}

std::size_t count_samples(const Patch& patch) {
  return patch.heights.size() -
         static_cast<std::size_t>(std::count(patch.heights.begin(), patch.heights.end(), kHole));
}

const PatchRun* run_of(const PatchModel& model, std::size_t patch) {
  const auto after =
      std::upper_bound(model.joined.begin(), model.joined.end(), patch,
                       [](std::size_t number, const PatchRun& run) { return number < run.first; });
  if (after == model.joined.begin()) return nullptr;
  const PatchRun& run = *std::prev(after);
  return patch - run.first < run.count ? &run : nullptr;
}

std::size_t count_samples(const PatchModel& model) {
  std::size_t sum = 0;
  for (const Patch& patch : model.patches) sum += count_samples(patch);
  return sum;
}

}  // namespace relief
