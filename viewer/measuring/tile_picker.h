// Picking in files with tiles, of which a window keeps nothing in full detail but on the GPU.
#pragma once

#include <cstdint>
#include <list>
#include <memory>
#include <optional>
#include <utility>

#include "common/error.h"
#include "loader/stream/tile_source.h"
#include "viewer/measuring/surface_pick.h"

namespace relief {

/// Reads again what is picked, and keeps the last few chunks.
class TilePicker {
 public:
  /// As SurfacePicker::pick(); patches are numbered as in the file. The first pick on a chunk reads
  /// it and makes its seams. Fails if it can't be read.
  Result<std::optional<SurfacePoint>> pick(const std::shared_ptr<TileSource>& tiles,
                                           const PickQuery& query);

  /// Drops all chunks.
  void forget();

 private:
  /// Pinned: the picker refers to the patches.
  struct Chunk {
    explicit Chunk(ChunkPatches read) : patches(std::move(read)), picker(patches.model) {}
    Chunk(const Chunk&) = delete;
    Chunk& operator=(const Chunk&) = delete;

    ChunkPatches patches;
    SurfacePicker picker;
  };
  Result<std::optional<SurfacePoint>> pick_on(std::uint32_t id, const PickQuery& query);

  std::shared_ptr<TileSource> tiles_;
  std::list<Chunk> chunks_;  ///< latest first
};

}  // namespace relief
