#include "loader/stream/chunk_cache.h"

#include <iterator>
#include <utility>

namespace relief {

void ChunkCache::put(ChunkKey key, std::shared_ptr<const PatchChunk> chunk, std::uint64_t bytes) {
  if (const auto found = found_.find(key); found != found_.end()) drop(found->second);
  if (bytes > budget_) return;
  kept_.push_front({key, std::move(chunk), bytes});
  found_[key] = kept_.begin();
  bytes_ += bytes;
  while (bytes_ > budget_) drop(std::prev(kept_.end()));
}

std::shared_ptr<const PatchChunk> ChunkCache::get(ChunkKey key) {
  const auto found = found_.find(key);
  if (found == found_.end()) return nullptr;
  kept_.splice(kept_.begin(), kept_, found->second);
  return found->second->chunk;
}

void ChunkCache::clear() {
  kept_.clear();
  found_.clear();
  bytes_ = 0;
}

void ChunkCache::drop(std::list<Kept>::iterator kept) {
  bytes_ -= kept->bytes;
  found_.erase(kept->key);
  kept_.erase(kept);
}

}  // namespace relief
