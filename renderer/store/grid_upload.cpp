#include "renderer/store/grid_upload.h"

#include <span>

#include "renderer/store/maps/map_upload.h"

namespace relief {
namespace {

/// What shaders know of a grid; where its maps are follows.
shared::PatchInfo info_of(const Patch& patch, const Grid& grid) {
  const auto stride = static_cast<float>(1U << grid.level);
  shared::PatchInfo info{};
  info.axis_v.w = grid.shape.height_step;
  info.axis_n.w = grid.shape.slope_step;
  info.nodes = {grid.nodes->width, grid.nodes->height, 0, grid.cells.first_row};
  const float begin = grid.level > 0 ? 1.0F : 0.0F;
  info.extent = {begin, begin + static_cast<float>(patch.width - 1) / stride,
                 begin + static_cast<float>(patch.height - 1) / stride, stride};
  return info;
}

glm::ivec4 map_position(const AtlasSpot& spot, std::int32_t scale) {
  return {spot.x, spot.y, spot.layer, scale};
}

/// `model` outlives it.
MeetsOthers meets_others(const PatchModel& model) {
  return [&model](const Patch& patch) {
    return run_of(model, static_cast<std::size_t>(&patch - model.patches.data())) != nullptr;
  };
}

/// The patches that grids are levels of, each once, and which of them each grid's is.
struct WholePatches {
  PatchList patches;
  std::vector<std::size_t> of_grids;
};

WholePatches whole_patches(const PatchModel& model, std::span<const Grid> grids) {
  WholePatches whole;
  std::map<std::size_t, std::size_t> numbers;
  for (const Grid& grid : grids) {
    const auto [found, is_new] = numbers.try_emplace(grid.patch, whole.patches.size());
    if (is_new) whole.patches.push_back(&model.patches[grid.patch]);
    whole.of_grids.push_back(found->second);
  }
  return whole;
}

/// Sets where the maps of whole patches are, in the cells of each level: `map` is the member for
/// them, `scale` the texels per cell.
template <class Scale>
void set_map_positions(const WholePatches& whole, const std::vector<AtlasSpot>& spots,
                       glm::ivec4 shared::PatchInfo::*map, const Scale& scale,
                       std::vector<Grid>& grids) {
  for (std::size_t k = 0; k < grids.size(); ++k) {
    const std::size_t patch = whole.of_grids[k];
    const std::int32_t texels = scale(*whole.patches[patch]) << grids[k].level;
    const std::int32_t before = grids[k].level > 0 ? texels : 0;  // it begins at node (1, 1)
    grids[k].info.*map = map_position(spots[patch], texels) - glm::ivec4(before, before, 0, 0);
  }
}

}  // namespace

GridUpload::GridUpload(const StoreLimits& limits, const PatchModel& model, const StoreNeeds& needs)
    : model_(model),
      needs_(needs),
      records_(limits.most_records),
      cells_(limits.most_cell_texels) {}

Result<std::size_t> GridUpload::get(std::size_t patch, std::uint32_t level) {
  const auto [found, is_new] = numbers_.try_emplace({patch, level}, grids_.size());
  if (!is_new) return found->second;
  const Patch& whole = model_.patches[patch];
  if (level > 0) coarser_.push_back(coarsen(whole, level));
  Grid grid;
  grid.patch = patch;
  grid.level = level;
  grid.nodes = level > 0 ? &coarser_.back().grid : &whole;
  const bool meets = run_of(model_, patch) != nullptr;
  grid.shape = level == 0 && meets && !needs_.splats
                   ? bound_samples(whole)
                   : make_samples(*grid.nodes, meets ? kReachToSeam : kReachToHole);
  if (needs_.splats) {
    RELIEF_TRY_ASSIGN(const RecordRun added, records_.add(grid.shape.records));
    grid.records = added;
  }
  if (needs_.cells) {
    RELIEF_TRY_ASSIGN(UploadedCells added,
                      cells_.add(level > 0 ? make_cells(coarser_.back(), grid.shape)
                                 : meets   ? make_joined_cells(whole)
                                           : make_cells(whole, grid.shape)));
    grid.cells = std::move(added);
  }
  grid.shape.records = {};
  grid.info = info_of(whole, grid);
  grids_.push_back(std::move(grid));
  return grids_.size() - 1;
}

Result<GridMaps> GridUpload::make_maps(const Gl& gl) {
  GridMaps made;
  if (needs_.heights) {
    PatchList nodes;
    for (const Grid& grid : grids_) nodes.push_back(grid.nodes);
    RELIEF_TRY_ASSIGN(MapArray maps, upload_heights(gl, nodes));
    for (std::size_t k = 0; k < grids_.size(); ++k)
      grids_[k].info.heights = map_position(maps.spots[k], 0);
    made.heights = std::move(maps.texture);
  }
  const WholePatches whole = whole_patches(model_, grids_);
  if (needs_.normals) {
    RELIEF_TRY_ASSIGN(MapArray maps, upload_normals(gl, whole.patches));
    set_map_positions(whole, maps.spots, &shared::PatchInfo::normals, normal_scale, grids_);
    made.normals = std::move(maps.texture);
  }
  if (needs_.colours) {
    RELIEF_TRY_ASSIGN(MapArray maps, upload_colours(gl, whole.patches, model_.has_label_colours));
    set_map_positions(whole, maps.spots, &shared::PatchInfo::colours, colour_scale, grids_);
    made.colours = std::move(maps.texture);
  }
  if (needs_.masks && !coarser_.empty()) {
    RELIEF_TRY_ASSIGN(MapArray maps, upload_masks(gl, whole.patches, meets_others(model_)));
    set_map_positions(
        whole, maps.spots, &shared::PatchInfo::masks, [](const Patch&) { return 1; }, grids_);
    made.masks = std::move(maps.texture);
  }
  return made;
}

MapBands GridUpload::make_bands() {
  MapBands made;
  if (needs_.heights) {
    PatchList nodes;
    for (const Grid& grid : grids_) nodes.push_back(grid.nodes);
    auto [band, spots] = pack_heights(nodes);
    for (std::size_t k = 0; k < grids_.size(); ++k)
      grids_[k].info.heights = map_position(spots[k], 0);
    made.heights = std::move(band);
  }
  const WholePatches whole = whole_patches(model_, grids_);
  if (needs_.normals) {
    auto [band, spots] = pack_normals(whole.patches);
    set_map_positions(whole, spots, &shared::PatchInfo::normals, normal_scale, grids_);
    made.normals = std::move(band);
  }
  if (needs_.colours) {
    auto [band, spots] = pack_colours(whole.patches);
    set_map_positions(whole, spots, &shared::PatchInfo::colours, colour_scale, grids_);
    made.colours = std::move(band);
  }
  if (needs_.masks) {
    auto [band, spots] = pack_masks(whole.patches, meets_others(model_));
    set_map_positions(
        whole, spots, &shared::PatchInfo::masks, [](const Patch&) { return 1; }, grids_);
    made.masks = std::move(band);
  }
  return made;
}

}  // namespace relief
