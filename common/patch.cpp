#include "common/patch.h"

#include <algorithm>

namespace relief {

std::size_t count_samples(const Patch& patch) {
  return patch.heights.size() -
         static_cast<std::size_t>(std::count(patch.heights.begin(), patch.heights.end(), kHole));
}

const PatchRun* run_of(const PatchModel& model, std::size_t patch) {
  for (const PatchRun& run : model.joined) {
    if (patch >= run.first && patch - run.first < run.count) return &run;
  }
  return nullptr;
}

std::size_t count_samples(const PatchModel& model) {
  std::size_t sum = 0;
  for (const Patch& patch : model.patches) sum += count_samples(patch);
  return sum;
}

}  // namespace relief
