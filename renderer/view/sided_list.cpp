#include "renderer/view/sided_list.h"

#include <algorithm>

namespace relief {
namespace {

/// By instance: whether the view shows its front alone.
std::vector<bool> front_alone(const PatchStore& store, const View& view) {
  std::vector<bool> alone;
  alone.reserve(store.instances.size());
  for (const StoredInstance& instance : store.instances) {
    const bool may =
        view.cull == CullMode::Auto || (view.cull == CullMode::Safe && instance.seams.count > 0);
    const bool outside = may && instance.body && sees_from_outside(view, *instance.body);
    alone.push_back((view.cull == CullMode::Back || outside) && !instance.is_mirrored);
  }
  return alone;
}

/// `patch_of` names the patch of a thing.
template <class PatchOf>
SidedList split(const PatchStore& store, const View& view, const std::vector<std::uint32_t>& things,
                const PatchOf& patch_of) {
  if (view.cull == CullMode::None) return {things, {}};
  const std::vector<bool> alone = front_alone(store, view);
  SidedList list;
  for (const std::uint32_t thing : things) {
    const bool front = alone[store.patches[patch_of(thing)].instance];
    (front ? list.front : list.both).push_back(thing);
  }
  return list;
}

}  // namespace

bool shows_backs(const PatchStore& store, const View& view) {
  if (view.cull == CullMode::None) return true;
  const std::vector<bool> alone = front_alone(store, view);
  return std::find(alone.begin(), alone.end(), false) != alone.end();
}

SidedList by_cull_mode(const PatchStore& store, const View& view,
                       const std::vector<std::uint32_t>& patches) {
  return split(store, view, patches, [](std::uint32_t patch) { return patch; });
}

SidedList parts_by_cull_mode(const PatchStore& store, const View& view,
                             const std::vector<std::uint32_t>& parts) {
  return split(store, view, parts,
               [&store](std::uint32_t part) { return store.cells->parts[part].patch; });
}

SidedList seams_by_cull_mode(const PatchStore& store, const View& view,
                             const std::vector<std::uint32_t>& seams) {
  return split(store, view, seams,
               [&store](std::uint32_t seam) { return store.seams->seams[seam].patch; });
}

}  // namespace relief
