// What a view shows of a file with tiles: on the GPU within a budget, read as the view moves.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "loader/stream/chunk_cost.h"
#include "loader/stream/cut.h"
#include "loader/stream/tile_loader.h"
#include "loader/stream/tile_source.h"
#include "renderer/settings.h"
#include "renderer/store/pool/patch_pool.h"
#include "renderer/view/patches_in_view.h"

namespace relief {

/// Bytes that a stream may take.
struct StreamBudget {
  std::uint64_t memory = 0;  ///< of chunks that were read
  std::uint64_t gpu = 0;     ///< of the GPU
};

/// What a window takes unless its user says otherwise: with a GPU, and where OpenGL runs on the
/// CPU. There both are the same memory, so that little of what is uploaded is kept twice; with a
/// third more, one view of 60 million points in six is finer (docs/decisions/0116).
inline constexpr StreamBudget kHardwareBudget{std::uint64_t{512} << 20U, std::uint64_t{1} << 30U};
inline constexpr StreamBudget kSoftwareBudget{std::uint64_t{48} << 20U, std::uint64_t{240} << 20U};

/// How far a stream is.
struct StreamState {
  std::size_t tiles = 0;  ///< of the file
  std::size_t shown_tiles = 0;
  std::uint64_t shown_samples = 0;
  std::size_t waiting = 0;      ///< chunks and indices that are still to be read
  bool is_coarser = false;      ///< than the view asks for, to fit the GPU's budget
  std::uint64_t gpu_bytes = 0;  ///< PatchPool::bytes()
  std::uint64_t cached_bytes = 0;
  LoaderCounts counts;
};

/// Keeps a pool (renderer/store/pool/patch_pool.h) filled with what views show of a file, in the
/// context of its OpenGL. Where something is not there yet, coarser patches stand in.
class StreamedPatches {
 public:
  /// `needs`: of the pool. `wake`: as TileLoader's. Reads what the first view needs least, so that
  /// there is a picture: the tiles without a parent.
  static Result<std::unique_ptr<StreamedPatches>> create(const Gl& gl,
                                                         std::shared_ptr<TileSource> source,
                                                         const StoreNeeds& needs,
                                                         const StreamBudget& budget,
                                                         std::span<const RenderSettings> views,
                                                         std::function<void()> wake);

  /// Makes the pool fit the views: takes what was read, for up to `ms` milliseconds, and asks for
  /// what is missing. Returns whether what is drawn has changed.
  bool update(std::span<const RenderSettings> views, double ms);

  /// Whether all that the last views need is drawn.
  [[nodiscard]] bool is_settled() const { return cut_.wanted.empty(); }

  /// Whether update() has something to do although the views are those of the last one.
  [[nodiscard]] bool has_news() const { return !has_room_ || loader_.has_news(); }

  /// What could not be read, once each.
  [[nodiscard]] std::vector<std::string> take_failures();

  [[nodiscard]] const PatchPool& pool() const { return pool_; }
  [[nodiscard]] StreamState state() const;

 private:
  /// A chunk on the GPU.
  struct Resident {
    ChunkSlot slot = 0;
    std::uint64_t number = 0;     ///< another one each time something is uploaded
    double rest = 0.0;            ///< bytes beside maps
    std::uint64_t last_seen = 0;  ///< the update in whose view it was
    std::uint32_t finest = 0;     ///< level that is there
    std::vector<Bounds> boxes;    ///< of its patches
  };

  /// What a chunk took when it was there last.
  struct KnownCost {
    ChunkCost cost;
    std::uint32_t finest = 0;  ///< level that was there
  };

  StreamedPatches(const Gl& gl, std::shared_ptr<TileSource> source, const StoreNeeds& needs,
                  const StreamBudget& budget, std::function<void()> wake);
  Status load_roots();
  void choose(std::span<const RenderSettings> views);
  void make_cut();
  [[nodiscard]] Cut cut_for(const TilePath& path) const;
  [[nodiscard]] std::uint32_t needed_level(const ChunkInfo& chunk) const;
  [[nodiscard]] ChunkCost cost_in_view(std::uint32_t tile) const;
  [[nodiscard]] const TileIndex* index_of(std::uint32_t tile) const;
  bool take(Loaded loaded);
  bool upload(ChunkKey key, const PatchChunk& chunk);
  bool add(ChunkKey key, const PatchChunk& chunk);
  bool make_room(const PatchChunk& chunk);
  void fill_less();
  void drop(std::map<ChunkKey, Resident>::iterator resident);
  bool show();
  void ask();
  void fail(const Want& want, std::string message);

  std::shared_ptr<TileSource> source_;
  PatchPool pool_;
  TileLoader loader_;
  std::vector<std::shared_ptr<const TileIndex>> indices_;  ///< by tile
  std::map<ChunkKey, Resident> residents_;
  double resident_rest_ = 0.0;           ///< Resident::rest of all
  std::map<ChunkKey, KnownCost> costs_;  ///< of each that was there once
  ChunkCost cost_of_finest_;             ///< of a node in these, a mean: in the finest tiles
  ChunkCost cost_of_overviews_;          ///< and in overviews
  ChunkCost room_;                       ///< what the budget is divided into
  bool has_room_ = false;                ///< the pool's textures are as large as that
  double fill_;                          ///< how much of it can be filled
  std::uint64_t less_filled_ = 0;        ///< the update that made it less

  std::vector<Onlooker> onlookers_;
  std::vector<double> level_pixels_;  ///< by onlooker: how far apart samples of levels may be seen
  bool is_coarser_ = false;
  Cut cut_;
  std::vector<CutPart> shown_;
  std::vector<std::uint64_t> shown_numbers_;  ///< Resident::number of each
  std::uint64_t uploads_ = 0;
  std::vector<Want> asked_;
  std::uint64_t updates_ = 0;

  std::map<std::pair<std::uint32_t, std::optional<std::uint32_t>>, double> failed_;  ///< when, s
  std::vector<std::string> failures_;
  std::vector<std::string> known_failures_;
};

}  // namespace relief
