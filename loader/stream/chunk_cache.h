// Prepared chunks that were needed lately.
#pragma once

#include <cstdint>
#include <list>
#include <map>
#include <memory>

#include "loader/stream/chunks.h"

namespace relief {

struct PatchChunk;

/// Keeps chunks in memory up to a number of bytes: those that were put or asked for last.
class ChunkCache {
 public:
  explicit ChunkCache(std::uint64_t budget) : budget_(budget) {}

  /// Keeps a chunk of that many bytes, in place of an older one with the key. One that exceeds the
  /// budget is not kept.
  void put(ChunkKey key, std::shared_ptr<const PatchChunk> chunk, std::uint64_t bytes);

  /// Returns the chunk, or null.
  [[nodiscard]] std::shared_ptr<const PatchChunk> get(ChunkKey key);

  void clear();

  [[nodiscard]] std::uint64_t bytes() const { return bytes_; }
  [[nodiscard]] std::size_t size() const { return kept_.size(); }

 private:
  struct Kept {
    ChunkKey key;
    std::shared_ptr<const PatchChunk> chunk;
    std::uint64_t bytes = 0;
  };
  void drop(std::list<Kept>::iterator kept);

  std::uint64_t budget_;
  std::uint64_t bytes_ = 0;
  std::list<Kept> kept_;  ///< the latest first
  std::map<ChunkKey, std::list<Kept>::iterator> found_;
};

}  // namespace relief
