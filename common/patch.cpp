#include "common/patch.h"

#include <algorithm>

namespace relief {

std::size_t count_samples(const Patch& patch) {
  return patch.heights.size() -
         static_cast<std::size_t>(std::count(patch.heights.begin(), patch.heights.end(), kHole));
}

std::size_t count_samples(const PatchModel& model) {
  std::size_t sum = 0;
  for (const Patch& patch : model.patches) sum += count_samples(patch);
  return sum;
}

}  // namespace relief
