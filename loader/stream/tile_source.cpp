#include "loader/stream/tile_source.h"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <system_error>

#include "common/patch_file/fast/zstd_contexts.h"
#include "common/patch_file/patch_file.h"
#include "common/progress.h"
#include "common/seams/join_normals.h"
#include "loader/models/assemble.h"
#include "loader/models/colour_by.h"
#include "loader/scene/view_settings.h"

namespace relief {
namespace {

/// Tiles that stay open: each has a file descriptor and the records of its patches.
constexpr std::size_t kMostOpenTiles = 64;

/// What is drawn of samples reaches this far beyond them, in spacings (renderer/view).
constexpr double kReach = 8.0;

/// Samples of the coarsest tiles that are read to choose colours: overviews end at 65,536, files
/// without them have all tiles there.
constexpr std::uint64_t kMostScaleSamples = std::uint64_t{1} << 20U;

/// Preparing a chunk takes about as many bytes again for each byte decoded.
constexpr std::uint64_t kPreparing = 3;

/// The scalar of a name; null if there is none.
const ScalarInfo* find_scalar(const std::vector<ScalarInfo>& scalars, const std::string& name) {
  const auto found = std::ranges::find(scalars, name, &ScalarInfo::name);
  return found != scalars.end() ? &*found : nullptr;
}

/// Whether the quantiles of the file are not enough to choose colours.
bool needs_samples(const PatchModel& extent, const ColourBy& colour_by) {
  const ScalarInfo* const scalar = find_scalar(extent.scalars, colour_by.scalar);
  return scalar == nullptr || scalar->is_label;
}

/// Whether colours can be chosen before all patches are read.
bool can_colour(const PatchTree& tree, const ColourBy& colour_by) {
  if (colour_by.scalar != kHeightScalar &&
      find_scalar(tree.extent().scalars, colour_by.scalar) == nullptr)
    return false;
  std::uint64_t coarsest = 0;
  for (const TreeTile& tile : tree.tiles()) coarsest += tile.parent == kNoTile ? tile.samples : 0;
  return coarsest <= kMostScaleSamples || !needs_samples(tree.extent(), colour_by);
}

bool has(const PatchFileInfo& info, const char* attribute) {
  return std::ranges::find(info.attributes, attribute) != info.attributes.end();
}

Bounds box_of(std::span<const TreeTile> tiles, const Transform& where) {
  Bounds box;
  for (const TreeTile& tile : tiles) {
    if (tile.box.empty()) continue;
    const double reach = kReach * tile.spacing;
    for (int corner = 0; corner < 8; ++corner) {
      glm::dvec3 p = tile.box.min - reach;
      for (int axis = 0; axis < 3; ++axis) {
        if ((corner >> axis & 1) != 0) p[axis] = tile.box.max[axis] + reach;
      }
      extend(box, moved(where, p));
    }
  }
  return box;
}

}  // namespace

Result<std::shared_ptr<TileSource>> TileSource::open(const ScenePlan& plan,
                                                     const std::optional<ColourBy>& colour_by) {
  if (plan.models.size() != 1 || !names_patch_file(plan.models.front().file))
    return std::shared_ptr<TileSource>();
  const std::filesystem::path& path = plan.models.front().file;
  std::error_code gone;
  const FileTime time = std::filesystem::last_write_time(path, gone);
  RELIEF_TRY_ASSIGN(PatchTree tree, PatchTree::open(path));
  if (tree.tiles().size() < 2 || gone) return std::shared_ptr<TileSource>();
  if (colour_by && !can_colour(tree, *colour_by)) return std::shared_ptr<TileSource>();
  std::shared_ptr<TileSource> made(new TileSource(path, std::move(tree)));
  made->time_ = time;
  made->colour_by_ = colour_by;
  std::uint32_t id = 0;
  for (const TreeTile& tile : made->tiles()) {
    made->first_ids_.push_back(id);
    id += tile.patches;
  }
  LoadedFile file;
  file.patches = made->tree_.extent();
  RELIEF_TRY(made->look_at_finest(file.patches));
  if (colour_by) {
    RELIEF_TRY(made->begin_colours(file.patches));
  }
  file.patches.scalars.clear();
  SceneAssembler assembler(false);
  RELIEF_TRY(for_each_use(plan.models, [&](const auto& /*path*/, const FileUse& use) {
    made->where_ = use.where;
    made->material_ = use.material;
    return assembler.add(file, use);
  }));
  made->scene_ = assembler.take();
  made->scene_.colours = made->scale_;
  made->scene_.patches.stance = made->tree_.extent().stance;
  made->box_ = box_of(made->tiles(), made->where_);
  return made;
}

Result<std::optional<LoadedScene>> load_tiles(const ScenePlan& plan, const LoadOptions& options) {
  std::optional<LoadedScene> scene;
  RELIEF_TRY_ASSIGN(const EngineEntry* const engine, engine_of(plan.views.front()));
  if (!engine->capabilities.needs_opengl || engine->forms.front() != ModelForm::Patches)
    return scene;
  RELIEF_TRY_ASSIGN(auto tiles, TileSource::open(plan, options.colour_by));
  if (tiles == nullptr) return scene;
  scene = tiles->scene();
  scene->tiles = std::move(tiles);
  return scene;
}

Status TileSource::look_at_finest(PatchModel& extent) {
  const auto tile = static_cast<std::uint32_t>(tiles().size() - 1);
  RELIEF_TRY_ASSIGN(const auto file, file_of(tile));
  extent.has_colours = has(file->info(), "colour");
  const std::vector<PatchSummary>& patches = file->patches();
  if (patches.empty()) return {};
  const auto nodes_of = [](const PatchSummary& p) { return std::uint64_t{p.width} * p.height; };
  const auto largest = std::ranges::max_element(patches, {}, nodes_of);
  const MapScales scales = file->map_scales(static_cast<std::uint64_t>(largest - patches.begin()));
  std::uint64_t nodes = 0;
  for (const PatchSummary& p : patches) nodes += nodes_of(p);
  const auto samples = static_cast<double>(std::max<std::uint64_t>(file->info().samples, 1));
  kind_ = {static_cast<double>(nodes) / samples, scales.normals, scales.colours};
  if (colour_by_) kind_.colour_texels = colour_by_->scalar == kHeightScalar ? 1 : scales.scalars;
  return {};
}

/// Chooses the scale by which all that is read from now on is coloured.
Status TileSource::begin_colours(PatchModel& extent) {
  sections_ = {.colours = false, .scalars = colour_by_->scalar != kHeightScalar};
  PatchModel coarse = extent;
  for (std::uint32_t t = 0; t < tiles().size(); ++t) {
    if (tiles()[t].parent != kNoTile || !needs_samples(extent, *colour_by_)) continue;
    RELIEF_TRY_ASSIGN(const auto file, file_of(t));
    Progress silent;
    RELIEF_TRY_ASSIGN(PatchModel of_tile, file->read_all(silent, sections_));
    std::ranges::move(of_tile.patches, std::back_inserter(coarse.patches));
  }
  auto scale = paint_patches(*colour_by_, {}, coarse);
  if (!scale) return make_error("{}: {}", path_.string(), scale.error().message);
  scale_ = *std::move(scale);
  extent.has_colours = true;
  extent.has_label_colours = coarse.has_label_colours;
  return {};
}

Status TileSource::check_unchanged() const {
  std::error_code gone;
  const FileTime now = std::filesystem::last_write_time(path_, gone);
  if (!gone && now == time_) return {};
  return make_error("{}: {} while it was shown; what has been read of it stays", path_.string(),
                    gone ? "has vanished" : "has changed");
}

Result<std::shared_ptr<const PatchFile>> TileSource::file_of(std::uint32_t tile) {
  {
    const std::lock_guard lock(mutex_);
    const auto found = std::ranges::find(files_, tile, [](const auto& f) { return f.first; });
    if (found != files_.end()) {
      files_.splice(files_.begin(), files_, found);
      return files_.front().second;
    }
  }
  RELIEF_TRY(check_unchanged());
  RELIEF_TRY_ASSIGN(PatchFile opened, tree_.open_tile(tile));
  auto file = std::make_shared<const PatchFile>(std::move(opened));
  const std::lock_guard lock(mutex_);
  files_.emplace_front(tile, file);
  if (files_.size() > kMostOpenTiles) files_.pop_back();
  return file;
}

Result<TileIndex> TileSource::read_index(std::uint32_t tile) {
  RELIEF_TRY_ASSIGN(const auto file, file_of(tile));
  return index_tile(file->patches(), !file->joined().empty());
}

Result<ChunkPatches> TileSource::read_patches(ChunkKey key, const ChunkInfo& chunk,
                                              const std::stop_token& stop) {
  RELIEF_TRY_ASSIGN(const auto file, file_of(key.tile));
  const std::vector<std::uint64_t> numbers(chunk.patches.begin(), chunk.patches.end());
  RELIEF_TRY(fits_memory(file->name(), kPreparing * file->decoded_bytes(numbers, sections_)));
  ChunkPatches read;
  PatchModel& model = read.model;
  model.spacing = file->info().spacing;
  model.bounds = chunk.box;
  model.is_closed = scene_.patches.is_closed;
  model.has_colours = scene_.patches.has_colours;
  ZstdContexts zstd;
  for (const std::uint32_t p : chunk.patches) {
    if (stop.stop_requested()) return interrupted_error();
    RELIEF_TRY_ASSIGN(Patch patch, file->read_patch(p, zstd, sections_));
    patch.material = material_;
    model.patches.push_back(std::move(patch));
    read.ids.push_back(first_ids_[key.tile] + p);
  }
  if (colour_by_) {
    model.scalars = tree_.extent().scalars;
    model.stance = tree_.extent().stance;
    const auto painted = paint_patches(*colour_by_, scale_, model);
    if (!painted) return make_error("{}: {}", file->name(), painted.error().message);
  }
  if (!file->joined().empty()) {
    model.joined.push_back(
        {0, static_cast<std::uint32_t>(model.patches.size()), file->joined().front().is_closed});
    join_normals(model);
  }
  if (const Status placed = transform_model(model, where_); !placed)
    return make_error("{}: {}", file->name(), placed.error().message);
  return read;
}

Result<ChunkPatches> TileSource::read_patches_with(std::uint32_t id) {
  const auto after = std::ranges::upper_bound(first_ids_, id);
  assert(after != first_ids_.begin() && "the first tile begins with 0");
  const auto tile = static_cast<std::uint32_t>(after - first_ids_.begin() - 1);
  RELIEF_TRY_ASSIGN(const TileIndex index, read_index(tile));
  for (std::uint32_t c = 0; c < index.chunks.size(); ++c) {
    const ChunkInfo& chunk = index.chunks[c];
    if (std::ranges::find(chunk.patches, id - first_ids_[tile]) != chunk.patches.end())
      return read_patches({tile, c}, chunk);
  }
  return make_error("{}: tile {} has no patch {}", path_.string(), tile, id - first_ids_[tile]);
}

Result<PatchChunk> TileSource::read_chunk(ChunkKey key, const ChunkInfo& chunk,
                                          const StoreNeeds& needs, const StoreLimits& limits,
                                          std::uint32_t finest, const std::stop_token& stop) {
  RELIEF_TRY_ASSIGN(const ChunkPatches read, read_patches(key, chunk, stop));
  RELIEF_TRY_ASSIGN(const auto file, file_of(key.tile));
  RELIEF_TRY_ASSIGN(PatchChunk made, prepare_chunk(read.model, read.ids, needs, limits, finest));
  for (const std::uint32_t p : chunk.patches)
    made.boxes.push_back(relief::box_of(file->patches()[p]));
  return made;
}

}  // namespace relief
