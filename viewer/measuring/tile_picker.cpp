#include "viewer/measuring/tile_picker.h"

#include <algorithm>
#include <utility>

namespace relief {
namespace {

/// A measurement goes back and forth between a few places.
constexpr std::size_t kMostChunks = 4;

}  // namespace

Result<std::optional<SurfacePoint>> TilePicker::pick(const std::shared_ptr<TileSource>& tiles,
                                                     const PickQuery& query) {
  if (tiles != tiles_) {
    forget();
    tiles_ = tiles;
  }
  RELIEF_TRY_ASSIGN(auto found, pick_on(query.patch, query));
  for (std::size_t k = 0; !found && k < query.others.size(); ++k) {
    RELIEF_TRY_ASSIGN(found, pick_on(query.others[k], query));
  }
  return found;
}

void TilePicker::forget() {
  chunks_.clear();
  tiles_.reset();
}

Result<std::optional<SurfacePoint>> TilePicker::pick_on(std::uint32_t id, const PickQuery& query) {
  const auto has_it = [id](const Chunk& chunk) {
    return std::ranges::find(chunk.patches.ids, id) != chunk.patches.ids.end();
  };
  if (const auto known = std::ranges::find_if(chunks_, has_it); known != chunks_.end()) {
    chunks_.splice(chunks_.begin(), chunks_, known);
  } else {
    RELIEF_TRY_ASSIGN(ChunkPatches read, tiles_->read_patches_with(id));
    if (chunks_.size() == kMostChunks) chunks_.pop_back();
    chunks_.emplace_front(std::move(read));
  }
  const Chunk& chunk = chunks_.front();
  const auto& ids = chunk.patches.ids;
  PickQuery own = query;
  own.patch = static_cast<std::uint32_t>(std::ranges::find(ids, id) - ids.begin());
  own.others = {};
  std::optional<SurfacePoint> point = chunk.picker.pick(own);
  if (point) point->patch = id;
  return point;
}

}  // namespace relief
