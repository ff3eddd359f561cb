// Reads what a view of a file with tiles needs, on threads of its own.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <tuple>
#include <vector>

#include "common/error.h"
#include "loader/stream/chunk_cache.h"
#include "loader/stream/cut.h"
#include "loader/stream/tile_source.h"

namespace relief {

/// Something that was read, or why it could not be.
struct Loaded {
  Want want;
  std::shared_ptr<const TileIndex> index;   ///< of a tile
  std::shared_ptr<const PatchChunk> chunk;  ///< of a chunk
  std::optional<std::string> failure;
};

/// How many bytes chunks that were read may take until they are uploaded, and after.
struct LoaderBudget {
  std::uint64_t waiting = 0;
  std::uint64_t cached = 0;
};

/// Figures of a loader since it began.
struct LoaderCounts {
  std::uint64_t indices = 0;
  std::uint64_t read = 0;    ///< chunks from the file
  std::uint64_t cached = 0;  ///< chunks from the cache
};

/// Reads in the order of a list that may be replaced at any time. Its functions are called from one
/// thread.
class TileLoader {
 public:
  /// `needs`: of the chunks. `wake` is called on another thread when there is something to take.
  TileLoader(std::shared_ptr<TileSource> source, const StoreNeeds& needs, const StoreLimits& limits,
             const LoaderBudget& budget, std::function<void()> wake);

  /// Ends the threads, each at the latest when it has prepared a chunk.
  ~TileLoader();
  TileLoader(const TileLoader&) = delete;
  TileLoader& operator=(const TileLoader&) = delete;

  /// What is to be read from now on, in that order; without what has been taken. What is being read
  /// is read to the end.
  void want(std::vector<Want> list);

  /// Returns the next thing that was read; none if there is none.
  [[nodiscard]] std::optional<Loaded> take();

  /// Whether there is something to take.
  [[nodiscard]] bool has_news() const;

  /// Reads something now, on this thread.
  [[nodiscard]] Loaded load(const Want& want);

  [[nodiscard]] std::uint64_t cached_bytes() const;
  [[nodiscard]] LoaderCounts counts() const;

 private:
  struct Order {
    bool operator()(const Want& a, const Want& b) const {
      return std::tie(a.tile, a.chunk, a.finest) < std::tie(b.tile, b.chunk, b.finest);
    }
  };
  void run(const std::stop_token& stop);
  std::optional<Want> next();  ///< under the lock
  [[nodiscard]] Loaded read(const Want& want, const std::stop_token& stop = {});

  std::shared_ptr<TileSource> source_;
  StoreNeeds needs_;
  StoreLimits limits_;
  LoaderBudget budget_;
  std::function<void()> wake_;
  mutable std::mutex mutex_;
  std::condition_variable_any changed_;
  std::deque<Want> wanted_;
  std::set<Want, Order> at_work_;
  std::deque<Loaded> done_;
  std::uint64_t done_bytes_ = 0;
  ChunkCache cache_;
  std::map<std::uint32_t, std::shared_ptr<const TileIndex>> indices_;
  LoaderCounts counts_;
  std::vector<std::jthread> threads_;  ///< last: they use all others
};

}  // namespace relief
