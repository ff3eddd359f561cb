#include "renderer/patch_store.h"

#include <algorithm>
#include <deque>
#include <glm/geometric.hpp>
#include <numeric>
#include <span>
#include <utility>

#include "renderer/map_upload.h"
#include "renderer/samples.h"
#include "shaders/include/shared.h"

namespace relief {
namespace {

/// What the shaders know of a level of a patch.
shared::PatchInfo info_of(const Patch& patch, std::size_t id, std::uint32_t level,
                          const Patch& coarse, const PatchSamples& samples,
                          std::int32_t first_row) {
  const auto stride = static_cast<float>(1U << level);
  shared::PatchInfo info{};
  info.axis_u = {glm::vec3(patch.axes[0]), static_cast<float>(coarse.spacing)};
  info.axis_v = {glm::vec3(patch.axes[1]), samples.height_step};
  info.axis_n = {glm::vec3(patch.axes[2]), samples.slope_step};
  info.nodes = {coarse.width, coarse.height, static_cast<int>(id), first_row};
  const float begin = level > 0 ? 1.0F : 0.0F;
  info.extent = {begin, begin + static_cast<float>(patch.width - 1) / stride,
                 begin + static_cast<float>(patch.height - 1) / stride, stride};
  info.heights.w = patch.material;
  return info;
}

StoredPatch stored(const Patch& patch, std::uint32_t level, const PatchSamples& samples) {
  StoredPatch kept;
  kept.level = level;
  kept.material = patch.material;
  kept.origin = patch.origin;
  kept.axes = patch.axes;
  kept.spacing = patch.spacing;
  kept.side = std::max(patch.width, patch.height);
  kept.centre = patch.origin + patch.axes * (patch.spacing * samples.centre);
  kept.radius = patch.spacing * samples.radius;
  kept.widest_disc = patch.spacing * samples.widest_disc;
  return kept;
}

glm::ivec4 place_of(const AtlasSpot& spot, std::int32_t scale) {
  return {spot.x, spot.y, spot.layer, scale};
}

/// The records of patches in the order of the model, cut into pages that shaders can see whole.
class Pages {
 public:
  explicit Pages(const Gl& gl) : gl_(gl) {
    // Quads count four vertices a record in signed 32-bit numbers.
    most_records_ = static_cast<std::size_t>(std::min(
        get_limit(gl, GL_MAX_TEXTURE_BUFFER_SIZE), std::numeric_limits<std::int32_t>::max() / 4));
  }

  Status add(StoredPatch& patch, const std::vector<SampleRecord>& records) {
    if (records.size() > most_records_) {
      return make_error(
          "a patch has {} samples, more than this OpenGL can draw ({}); convert again "
          "with a larger spacing",
          records.size(), most_records_);
    }
    if (current_.size() + records.size() > most_records_) flush();
    patch.page = static_cast<std::uint32_t>(pages_.size());
    patch.first_record = static_cast<std::uint32_t>(current_.size());
    patch.records = static_cast<std::uint32_t>(records.size());
    current_.insert(current_.end(), records.begin(), records.end());
    return {};
  }

  std::vector<Table> take() {
    if (!current_.empty()) flush();
    return std::move(pages_);
  }

 private:
  void flush() {
    pages_.push_back(
        make_table(gl_, "sample records", GL_RGBA32UI, std::span<const SampleRecord>(current_)));
    current_.clear();
  }

  const Gl& gl_;
  std::size_t most_records_ = 0;
  std::vector<SampleRecord> current_;
  std::vector<Table> pages_;
};

/// Which patch and which of its levels each stored one is.
struct Origin {
  std::size_t patch = 0;
  std::uint32_t level = 0;
};

/// Where the maps of patches are: `place` is the member for them, `scale` the texels per cell.
template <class Scale>
void note_places(const PatchModel& model, const std::vector<Origin>& origins,
                 const std::vector<AtlasSpot>& spots, glm::ivec4 shared::PatchInfo::*place,
                 const Scale& scale, std::vector<shared::PatchInfo>& table) {
  for (std::size_t k = 0; k < table.size(); ++k) {
    const auto [patch, level] = origins[k];
    const std::int32_t texels = scale(model.patches[patch]) << level;
    const std::int32_t before = level > 0 ? texels : 0;  // the patch begins at node (1, 1)
    table[k].*place = place_of(spots[patch], texels) - glm::ivec4(before, before, 0, 0);
  }
}

}  // namespace

Result<PatchStore> upload_model(const Gl& gl, const PatchModel& model, const StoreNeeds& needs,
                                std::span<const View> views) {
  std::vector<shared::PatchInfo> table;
  std::vector<StoredPatch> patches;
  std::vector<StoredLevels> levels;
  std::vector<Origin> origins;
  std::deque<PatchLevel> coarser;
  PatchList grids;
  PatchList whole;
  Pages pages(gl);
  CellUpload cells(gl);
  for (std::size_t p = 0; p < model.patches.size(); ++p) {
    const Patch& patch = model.patches[p];
    const PatchExtent extent = extent_of(patch);
    const std::vector<std::uint32_t> kept = levels_in(views, extent);
    levels.push_back({extent, static_cast<std::uint32_t>(patches.size()),
                      static_cast<std::uint32_t>(kept.size())});
    for (const std::uint32_t level : kept) {
      if (level > 0) coarser.push_back(coarsen(patch, level));
      const Patch& grid = level > 0 ? coarser.back().grid : patch;
      const PatchSamples samples = make_samples(grid);
      patches.push_back(stored(grid, level, samples));
      if (needs.splats) {
        const Status added = pages.add(patches.back(), samples.records);
        if (!added) return added.error();
      }
      std::int32_t first_row = 0;
      if (needs.cells) {
        const Result<std::int32_t> added = cells.add(
            grid, level > 0 ? make_cells(coarser.back(), samples) : make_cells(patch, samples));
        if (!added) return added.error();
        first_row = *added;
      }
      table.push_back(info_of(patch, p, level, grid, samples, first_row));
      origins.push_back({p, level});
      grids.push_back(&grid);
    }
    whole.push_back(&patch);
  }

  std::optional<Texture> heights;
  std::optional<Texture> normals;
  std::optional<Texture> colours;
  std::optional<Texture> masks;
  if (needs.heights) {
    Result<MapArray> maps = upload_heights(gl, grids);
    if (!maps) return maps.error();
    for (std::size_t k = 0; k < table.size(); ++k)
      table[k].heights = place_of(maps->spots[k], table[k].heights.w);
    heights = std::move(maps->texture);
  }
  if (needs.normals) {
    Result<MapArray> maps = upload_normals(gl, whole);
    if (!maps) return maps.error();
    note_places(model, origins, maps->spots, &shared::PatchInfo::normals, normal_scale, table);
    normals = std::move(maps->texture);
  }
  if (needs.colours) {
    Result<MapArray> maps = upload_colours(gl, whole);
    if (!maps) return maps.error();
    note_places(model, origins, maps->spots, &shared::PatchInfo::colours, colour_scale, table);
    colours = std::move(maps->texture);
  }
  if (needs.masks && !coarser.empty()) {
    Result<MapArray> maps = upload_masks(gl, whole);
    if (!maps) return maps.error();
    note_places(
        model, origins, maps->spots, &shared::PatchInfo::masks, [](const Patch&) { return 1; },
        table);
    masks = std::move(maps->texture);
  }

  PatchStore store{
      std::move(patches),
      std::move(levels),
      pages.take(),
      make_table(gl, "patch table", GL_RGBA32I, std::span<const shared::PatchInfo>(table)),
      std::nullopt,
      std::move(heights),
      std::move(normals),
      std::move(colours),
      std::move(masks),
      std::nullopt};
  if (needs.cells) store.cells = cells.take();
  if (needs.splats || !needs.cells) {
    std::vector<std::uint32_t> indices(store.patches.size());
    std::iota(indices.begin(), indices.end(), 0U);
    store.indices = make_buffer(gl, "patch indices", std::span<const std::uint32_t>(indices));
  }
  const Status uploaded = check_errors(gl, "the model");
  if (!uploaded) return uploaded.error();
  return store;
}

std::vector<std::uint32_t> levels_for(const PatchStore& store, const View& view) {
  std::vector<std::uint32_t> chosen;
  chosen.reserve(store.levels.size());
  for (const StoredLevels& kept : store.levels) {
    const std::uint32_t level = choose_level(view, kept.extent);
    std::uint32_t best = kept.first;
    for (std::uint32_t k = kept.first + 1; k < kept.first + kept.count; ++k) {
      if (store.patches[k].level <= level) best = k;
    }
    chosen.push_back(best);
  }
  return chosen;
}

}  // namespace relief
