#include "renderer/view/patches_in_view.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <iterator>

#include "common/seams/join_normals.h"
#include "common/transform.h"
#include "renderer/engines/onepass/back.h"
#include "renderer/frame/image_parts.h"
#include "renderer/shading/materials.h"
#include "renderer/view/box_in_view.h"

namespace relief {
namespace {

/// Splats reach less far beyond samples at a patch's border (renderer/splat_reach.h).
constexpr double kReachInSpacings = 8.0;

/// Coarser levels of a patch reach beyond it by up to two of their cells, whose samples are seen
/// pixels_per_sample_of() apart.
constexpr double kReachInCells = 2.0;

/// An overview has one normal and one colour a sample: farther apart than pixels they would blur.
constexpr double kPixelsPerOverviewSample = 1.0;

/// Whether samples `spacing` apart, in a box of the file, can be in the image.
bool sees(const Onlooker& onlooker, const Bounds& box, double spacing) {
  const double reach = onlooker.transform.scale * kReachInSpacings * spacing;
  return !box.empty() && sees_box(onlooker.view, {box, onlooker.transform}, reach);
}

bool sees(const Onlooker& onlooker, const PatchSummary& patch) {
  if (patch.samples == 0) return false;
  const Bounds box{{0.0, 0.0, patch.min_height * patch.height_step},
                   {(patch.width - 1) * patch.spacing, (patch.height - 1) * patch.spacing,
                    patch.max_height * patch.height_step}};
  const Transform& model = onlooker.transform;
  const Transform frame{moved(model, patch.origin), model.rotation * patch.axes, model.scale};
  return sees_box(onlooker.view, {box, frame}, model.scale * kReachInSpacings * patch.spacing);
}

/// Whether a box's samples, where it is nearest to the eye, are as near to each other as asked for.
bool is_fine_enough(const Onlooker& onlooker, const Bounds& box, double spacing) {
  const double depth = nearest_depth(onlooker.view, {box, onlooker.transform});
  if (depth <= 0.0 && !onlooker.view.orthographic) return false;
  return spacing * onlooker.transform.scale <= onlooker.pixels * pixel_at(onlooker.view, depth);
}

/// Each tile's box about its own samples and those of all that it stands for, which may reach a
/// little farther.
std::vector<Bounds> whole_boxes(std::span<const TreeTile> tiles) {
  std::vector<Bounds> boxes;
  for (const TreeTile& tile : tiles) boxes.push_back(tile.box);
  for (std::size_t t = tiles.size(); t-- > 0;) {
    if (tiles[t].parent == kNoTile || boxes[t].empty()) continue;
    extend(boxes[tiles[t].parent], boxes[t].min);
    extend(boxes[tiles[t].parent], boxes[t].max);
  }
  return boxes;
}

/// Which tiles have each one for their parent; last those without.
std::vector<std::vector<std::uint32_t>> children_of(std::span<const TreeTile> tiles) {
  std::vector<std::vector<std::uint32_t>> children(tiles.size() + 1);
  for (std::uint32_t t = 0; t < tiles.size(); ++t)
    children[std::min<std::size_t>(tiles[t].parent, tiles.size())].push_back(t);
  return children;
}

}  // namespace

std::vector<Onlooker> onlookers_of(std::span<const RenderSettings> views,
                                   std::span<const Transform> transforms,
                                   const PatchModel& extent) {
  std::vector<Onlooker> onlookers;
  for (const RenderSettings& settings : views) {
    View view = make_view(settings.camera, settings.width, settings.height,
                          {1.0, extent.bounds, extent.spacing});
    // What is refracted may be beside the image.
    const double beside = has_two_interfaces(settings) ? onepass::kBackBorder : 0.0;
    const double border = kReachInCells * pixels_per_sample_of(settings) +
                          beside * std::max(settings.width, settings.height);
    view = with_border(view, static_cast<std::uint32_t>(std::ceil(border)));
    const double pixels = std::min(kPixelsPerOverviewSample, pixels_per_sample_of(settings)) /
                          samples_a_side(settings.samples);
    for (const Transform& transform : transforms) onlookers.push_back({view, transform, pixels});
  }
  return onlookers;
}

bool is_in_view(std::span<const Onlooker> onlookers, const Bounds& box, double spacing) {
  return std::any_of(onlookers.begin(), onlookers.end(),
                     [&](const Onlooker& onlooker) { return sees(onlooker, box, spacing); });
}

double coarseness(std::span<const Onlooker> onlookers, const Bounds& box, double spacing) {
  constexpr double kNearest = 0.02;
  double most = 0.0;
  for (const Onlooker& onlooker : onlookers) {
    if (!sees(onlooker, box, spacing)) continue;
    const double scale = onlooker.transform.scale;
    const double least = kNearest * scale * glm::distance(box.min, box.max);
    const double depth = std::max(nearest_depth(onlooker.view, {box, onlooker.transform}), least);
    most = std::max(most, spacing * scale / (onlooker.pixels * pixel_at(onlooker.view, depth)));
  }
  return most;
}

std::vector<std::uint32_t> choose_tiles(std::span<const TreeTile> tiles,
                                        std::span<const Onlooker> onlookers) {
  const std::vector<Bounds> boxes = whole_boxes(tiles);
  const std::vector<std::vector<std::uint32_t>> children = children_of(tiles);
  std::vector<std::uint32_t> chosen;
  std::vector<std::uint32_t> open = children.back();
  while (!open.empty()) {
    const std::uint32_t t = open.back();
    open.pop_back();
    const Bounds& box = boxes[t];
    const double spacing = tiles[t].spacing;
    if (!is_in_view(onlookers, box, spacing)) continue;
    // What is too scattered for an overview may still be there in its children.
    const bool is_enough =
        children[t].empty() || (tiles[t].samples > 0 &&
                                std::all_of(onlookers.begin(), onlookers.end(), [&](const auto& o) {
                                  return !sees(o, box, spacing) || is_fine_enough(o, box, spacing);
                                }));
    if (is_enough) {
      chosen.push_back(t);
    } else {
      open.insert(open.end(), children[t].begin(), children[t].end());
    }
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

Result<PartialModel> read_in_view(const PatchTree& tree, std::span<const Onlooker> onlookers,
                                  Progress& progress, const PatchSections& sections) {
  PartialModel read;
  read.model = tree.extent();
  if (!sections.scalars) read.model.scalars.clear();
  const std::vector<std::uint32_t> tiles = choose_tiles(tree.tiles(), onlookers);
  std::uint64_t patches = 0;
  for (const std::uint32_t t : tiles) patches += tree.tiles()[t].patches;
  progress.begin_stage("reading patches", patches);
  PartProgress inner(progress);
  std::uint64_t bytes = 0;
  for (const std::uint32_t t : tiles) {
    RELIEF_TRY_ASSIGN(const auto file, tree.open_tile(t));
    std::vector<std::uint64_t> seen;
    for (std::uint64_t p = 0; p < file.patches().size(); ++p) {
      const PatchSummary& patch = file.patches()[p];
      if (std::ranges::any_of(onlookers, [&](const auto& o) { return sees(o, patch); }))
        seen.push_back(p);
    }
    progress.advance(file.patches().size() - seen.size());
    bytes += file.decoded_bytes(seen, sections);
    if (!file.joined().empty()) {
      for (const std::uint64_t p : seen) bytes += kJoiningBytes * file.patches()[p].samples;
    }
    RELIEF_TRY(fits_memory(file.name(), bytes));
    RELIEF_TRY_ASSIGN(auto some, file.read_patches(seen, inner, sections));
    read.bytes += file.bytes_read();
    if (!file.joined().empty() && !seen.empty()) {
      read.model.joined.push_back({static_cast<std::uint32_t>(read.model.patches.size()),
                                   static_cast<std::uint32_t>(seen.size())});
    }
    for (const std::uint64_t p : seen) read.samples += file.patches()[p].samples;
    std::move(some.begin(), some.end(), std::back_inserter(read.model.patches));
  }
  join_normals(read.model);
  read.tiles = tiles.size();
  read.model.has_colours = std::any_of(read.model.patches.begin(), read.model.patches.end(),
                                       [](const Patch& patch) { return !patch.colours.empty(); });
  return read;
}

}  // namespace relief
