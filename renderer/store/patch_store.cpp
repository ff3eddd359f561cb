#include "renderer/store/patch_store.h"

namespace relief {

std::vector<std::uint32_t> levels_for(const PatchStore& store, const View& view) {
  std::vector<std::uint32_t> chosen;
  for (const StoredPlacement& placement : store.placements) {
    if (placement.is_far_in(view)) continue;
    for (std::uint32_t l = placement.first; l < placement.first + placement.count; ++l) {
      const StoredLevels& kept = store.levels[l];
      const std::uint32_t level = choose_level(view, kept.extent);
      std::uint32_t best = kept.first;
      for (std::uint32_t k = kept.first + 1; k < kept.first + kept.count; ++k) {
        if (store.patches[k].level <= level) best = k;
      }
      chosen.push_back(best);
    }
  }
  return chosen;
}

}  // namespace relief
