#include "renderer/store/patch_store.h"

namespace relief {

std::vector<std::uint32_t> levels_for(const PatchStore& store, const View& view) {
  std::vector<std::uint32_t> chosen;
  for (const StoredInstance& instance : store.instances) {
    if (instance.is_proxy_in(view)) continue;
    for (std::uint32_t l = instance.first; l < instance.first + instance.count; ++l) {
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

std::vector<std::uint8_t> drawn_levels(const PatchStore& store, const View& view) {
  std::vector<std::uint8_t> levels(store.levels.size(), kDrawnFromAfar);
  const std::vector<std::uint32_t> chosen = levels_for(store, view);
  auto next = chosen.begin();
  for (const StoredInstance& instance : store.instances) {
    if (instance.is_proxy_in(view)) continue;
    for (std::uint32_t l = instance.first; l < instance.first + instance.count; ++l)
      levels[l] = static_cast<std::uint8_t>(store.patches[*next++].level);
  }
  return levels;
}

}  // namespace relief
