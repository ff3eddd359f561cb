// A scene of one patch file with tiles, of which chunks are read one by one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <stop_token>
#include <utility>
#include <vector>

#include "common/error.h"
#include "common/patch_file/patch_tree.h"
#include "common/scalars/colour_scale.h"
#include "common/transform.h"
#include "loader/load_scene.h"
#include "loader/scene/loaded_scene.h"
#include "loader/scene/scene_plan.h"
#include "loader/stream/chunks.h"
#include "renderer/store/pool/patch_chunk.h"

namespace relief {

/// What the finest patches of a file are like, by one of them.
struct PatchKind {
  double nodes_a_sample = 2.0;
  std::uint32_t normal_texels = 1;  ///< a cell along a side
  std::uint32_t colour_texels = 1;
};

/// The patches of a chunk.
struct ChunkPatches {
  PatchModel model;                ///< in its place, with the normals of patches that meet joined
  std::vector<std::uint32_t> ids;  ///< by patch: its number in the file
};

/// An open file. Thread-safe but for its construction.
class TileSource {
 public:
  /// Opens the file of a plan, if it is all that the plan shows, and has tiles and the scalar that
  /// it is to be coloured by; otherwise null. Reads the list of tiles and the index of the last
  /// one. To colour by height or by labels it reads the coarsest tiles, too: the scale has their
  /// heights or labels. Null also if these are too large, as in files without overviews. Fails as
  /// PatchTree::open() does, or if the range of colours is empty.
  static Result<std::shared_ptr<TileSource>> open(const ScenePlan& plan,
                                                  const std::optional<ColourBy>& colour_by = {});

  [[nodiscard]] std::span<const TreeTile> tiles() const { return tree_.tiles(); }
  /// Where the model stands.
  [[nodiscard]] const Transform& where() const { return where_; }
  /// The scene without patches: bounds and attributes of all of it.
  [[nodiscard]] const LoadedScene& scene() const { return scene_; }
  [[nodiscard]] const PatchKind& kind() const { return kind_; }
  /// A box about all that can be drawn of it, world.
  [[nodiscard]] const Bounds& box() const { return box_; }

  /// Reads the index of a tile. Errors are sentences that begin with the file's name.
  Result<TileIndex> read_index(std::uint32_t tile);

  /// Reads the patches of a chunk of a tile. Ends early, with an error, once `stop` asks for it.
  Result<ChunkPatches> read_patches(ChunkKey key, const ChunkInfo& chunk,
                                    const std::stop_token& stop = {});

  /// Reads the chunk that has the patch of a number in the file.
  Result<ChunkPatches> read_patches_with(std::uint32_t id);

  /// Reads a chunk of a tile and prepares its levels from `finest` on for the GPU. The chunk's
  /// boxes are in the file's frame. Ends early, with an error, once `stop` asks for it.
  Result<PatchChunk> read_chunk(ChunkKey key, const ChunkInfo& chunk, const StoreNeeds& needs,
                                const StoreLimits& limits, std::uint32_t finest,
                                const std::stop_token& stop = {});

 private:
  using FileTime = std::filesystem::file_time_type;

  TileSource(std::filesystem::path path, PatchTree tree)
      : path_(std::move(path)), tree_(std::move(tree)) {}
  Result<std::shared_ptr<const PatchFile>> file_of(std::uint32_t tile);
  Status check_unchanged() const;
  Status look_at_finest(PatchModel& extent);
  Status begin_colours(PatchModel& extent);

  std::filesystem::path path_;
  PatchTree tree_;
  Transform where_;
  std::uint8_t material_ = 0;
  LoadedScene scene_;
  Bounds box_;
  PatchKind kind_;
  std::optional<ColourBy> colour_by_;
  std::optional<ColourScale> scale_;  ///< of that
  PatchSections sections_ = {.scalars = false};
  FileTime time_;
  std::vector<std::uint32_t> first_ids_;  ///< by tile: the patch id of its first

  std::mutex mutex_;
  std::list<std::pair<std::uint32_t, std::shared_ptr<const PatchFile>>> files_;  ///< latest first
};

/// Returns the scene of a plan with LoadedScene::tiles, if its patches can be read as views need
/// them: if TileSource::open() opens the plan and the engine draws patches on OpenGL. Otherwise
/// nothing. Fails as that does.
Result<std::optional<LoadedScene>> load_tiles(const ScenePlan& plan, const LoadOptions& options);

}  // namespace relief
