// What images need of a patch file that is larger than what they show: of each region the
// coarsest patches that look like the finest, and of regions that are not seen none.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/error.h"
#include "common/patch_file/patch_tree.h"
#include "common/progress.h"
#include "renderer/settings.h"
#include "renderer/view/view.h"

namespace relief {

/// One instance of a file's model in one view.
struct Onlooker {
  View view;
  Transform transform;
  /// Samples may be seen this far apart, in pixels; 0: they are to be the finest.
  double pixels = 1.0;
};

/// Each instance in each view. `extent`: of all that is drawn.
[[nodiscard]] std::vector<Onlooker> onlookers_of(std::span<const RenderSettings> views,
                                                 std::span<const Transform> transforms,
                                                 const PatchModel& extent);

/// Whether some onlooker may see samples in a box of the file, which are `spacing` apart.
[[nodiscard]] bool is_in_view(std::span<const Onlooker> onlookers, const Bounds& box,
                              double spacing);

/// How many times as far apart as they may be some onlooker sees the samples of a box, where it is
/// nearest; 0 if none sees it. About the eye as from a fiftieth of the box's diagonal.
[[nodiscard]] double coarseness(std::span<const Onlooker> onlookers, const Bounds& box,
                                double spacing);

/// The tiles whose patches show all that is seen, in the list's order: no region is in two of them.
/// A tile stands for its children where its samples are seen at most Onlooker::pixels apart.
[[nodiscard]] std::vector<std::uint32_t> choose_tiles(std::span<const TreeTile> tiles,
                                                      std::span<const Onlooker> onlookers);

/// What was read of a file, and what there is.
struct PartialModel {
  PatchModel model;
  std::size_t tiles = 0;
  std::uint64_t samples = 0;
  SectionBytes bytes = {};  ///< of the file
};

/// Reads what the onlookers need, and of patches the maps that `sections` names. Refuses what does
/// not fit into this machine's memory.
Result<PartialModel> read_in_view(const PatchTree& tree, std::span<const Onlooker> onlookers,
                                  Progress& progress, const PatchSections& sections = {});

}  // namespace relief
