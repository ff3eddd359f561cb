#include "renderer/patch_store.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <numeric>
#include <span>
#include <utility>

#include "renderer/map_upload.h"
#include "renderer/samples.h"
#include "shaders/include/shared.h"

namespace relief {
namespace {

shared::PatchInfo info_of(const Patch& patch, const PatchSamples& samples, std::size_t id,
                          std::int32_t first_row) {
  shared::PatchInfo info{};
  info.axis_u = {glm::vec3(patch.axes[0]), static_cast<float>(patch.spacing)};
  info.axis_v = {glm::vec3(patch.axes[1]), samples.height_step};
  info.axis_n = {glm::vec3(patch.axes[2]), samples.slope_step};
  info.nodes = {patch.width, patch.height, static_cast<int>(id), first_row};
  info.heights.w = patch.material;
  return info;
}

StoredPatch stored(const Patch& patch, const PatchSamples& samples) {
  StoredPatch kept;
  kept.origin = patch.origin;
  kept.axes = patch.axes;
  kept.spacing = patch.spacing;
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

}  // namespace

Result<PatchStore> upload_model(const Gl& gl, const PatchModel& model, const StoreNeeds& needs) {
  std::vector<shared::PatchInfo> table;
  std::vector<StoredPatch> patches;
  Pages pages(gl);
  CellUpload cells(gl);
  for (std::size_t p = 0; p < model.patches.size(); ++p) {
    const Patch& patch = model.patches[p];
    const PatchSamples samples = make_samples(patch);
    patches.push_back(stored(patch, samples));
    if (needs.splats) {
      const Status added = pages.add(patches.back(), samples.records);
      if (!added) return added.error();
    }
    std::int32_t first_row = 0;
    if (needs.cells) {
      const Result<std::int32_t> added = cells.add(patch, samples);
      if (!added) return added.error();
      first_row = *added;
    }
    table.push_back(info_of(patch, samples, p, first_row));
  }

  std::optional<Texture> heights;
  std::optional<Texture> normals;
  std::optional<Texture> colours;
  if (needs.heights) {
    Result<MapArray> maps = upload_heights(gl, model);
    if (!maps) return maps.error();
    for (std::size_t p = 0; p < table.size(); ++p)
      table[p].heights = place_of(maps->spots[p], table[p].heights.w);
    heights = std::move(maps->texture);
  }
  if (needs.normals) {
    Result<MapArray> maps = upload_normals(gl, model);
    if (!maps) return maps.error();
    for (std::size_t p = 0; p < table.size(); ++p)
      table[p].normals = place_of(maps->spots[p], normal_scale(model.patches[p]));
    normals = std::move(maps->texture);
  }
  if (needs.colours) {
    Result<MapArray> maps = upload_colours(gl, model);
    if (!maps) return maps.error();
    for (std::size_t p = 0; p < table.size(); ++p)
      table[p].colours = place_of(maps->spots[p], colour_scale(model.patches[p]));
    colours = std::move(maps->texture);
  }

  std::vector<std::uint32_t> indices(model.patches.size());
  std::iota(indices.begin(), indices.end(), 0U);
  PatchStore store{
      std::move(patches),
      pages.take(),
      make_table(gl, "patch table", GL_RGBA32I, std::span<const shared::PatchInfo>(table)),
      make_buffer(gl, "patch indices", std::span<const std::uint32_t>(indices)),
      std::move(heights),
      std::move(normals),
      std::move(colours),
      std::nullopt};
  if (needs.cells) store.cells = cells.take();
  const Status uploaded = check_errors(gl, "the model");
  if (!uploaded) return uploaded.error();
  return store;
}

}  // namespace relief
