#include "loader/stream/tile_loader.h"

#include <algorithm>
#include <exception>
#include <utility>

namespace relief {
namespace {

/// One core is left to the window.
unsigned thread_count() {
  return std::clamp(std::thread::hardware_concurrency(), 2U, 5U) - 1U;
}

}  // namespace

TileLoader::TileLoader(std::shared_ptr<TileSource> source, const StoreNeeds& needs,
                       const StoreLimits& limits, const LoaderBudget& budget,
                       std::function<void()> wake)
    : source_(std::move(source)),
      needs_(needs),
      limits_(limits),
      budget_(budget),
      wake_(std::move(wake)),
      cache_(budget.cached) {
  for (unsigned k = 0; k < thread_count(); ++k)
    threads_.emplace_back([this](const std::stop_token& stop) { run(stop); });
}

TileLoader::~TileLoader() {
  for (std::jthread& thread : threads_) thread.request_stop();
}

void TileLoader::want(std::vector<Want> list) {
  {
    const std::lock_guard lock(mutex_);
    wanted_.assign(list.begin(), list.end());
  }
  changed_.notify_all();
}

std::optional<Loaded> TileLoader::take() {
  std::optional<Loaded> taken;
  {
    const std::lock_guard lock(mutex_);
    if (done_.empty()) return taken;
    taken = std::move(done_.front());
    done_.pop_front();
    if (taken->chunk) done_bytes_ -= taken->chunk->bytes();
  }
  changed_.notify_all();
  return taken;
}

bool TileLoader::has_news() const {
  const std::lock_guard lock(mutex_);
  return !done_.empty();
}

Loaded TileLoader::load(const Want& want) {
  return read(want);
}

std::uint64_t TileLoader::cached_bytes() const {
  const std::lock_guard lock(mutex_);
  return cache_.bytes();
}

LoaderCounts TileLoader::counts() const {
  const std::lock_guard lock(mutex_);
  return counts_;
}

std::optional<Want> TileLoader::next() {
  if (done_bytes_ > budget_.waiting) return std::nullopt;
  while (!wanted_.empty()) {
    const Want want = wanted_.front();
    wanted_.pop_front();
    const bool is_done =
        std::ranges::any_of(done_, [&](const Loaded& loaded) { return loaded.want == want; });
    if (is_done || at_work_.contains(want)) continue;
    at_work_.insert(want);
    return want;
  }
  return std::nullopt;
}

void TileLoader::run(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    std::optional<Want> want;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, stop, [&] { return (want = next()).has_value(); });
    }
    if (!want) return;
    Loaded loaded = read(*want, stop);
    {
      const std::lock_guard lock(mutex_);
      at_work_.erase(*want);
      if (loaded.chunk) done_bytes_ += loaded.chunk->bytes();
      done_.push_back(std::move(loaded));
    }
    wake_();
  }
}

Loaded TileLoader::read(const Want& want, const std::stop_token& stop) {
  Loaded loaded{want, nullptr, nullptr, std::nullopt};
  std::shared_ptr<const TileIndex> index;
  {
    const std::lock_guard lock(mutex_);
    if (const auto found = indices_.find(want.tile); found != indices_.end()) index = found->second;
    if (want.chunk) loaded.chunk = cache_.get({want.tile, *want.chunk});
    if (loaded.chunk && loaded.chunk->finest > want.finest) loaded.chunk = nullptr;
    if (loaded.chunk) ++counts_.cached;
  }
  if (loaded.chunk) return loaded;
  const auto read_it = [&]() -> Status {
    if (index == nullptr) {
      RELIEF_TRY_ASSIGN(TileIndex read, source_->read_index(want.tile));
      index = std::make_shared<const TileIndex>(std::move(read));
    }
    if (!want.chunk) return {};
    const ChunkKey key{want.tile, *want.chunk};
    RELIEF_TRY_ASSIGN(PatchChunk chunk, source_->read_chunk(key, index->chunks[key.chunk], needs_,
                                                            limits_, want.finest, stop));
    loaded.chunk = std::make_shared<const PatchChunk>(std::move(chunk));
    return {};
  };
  try {
    if (const Status status = read_it(); !status) loaded.failure = status.error().message;
  } catch (const std::exception& error) {  // of preparing: there is no memory
    loaded.failure = "tile " + std::to_string(want.tile) + " can't be prepared: " + error.what();
  }
  const std::lock_guard lock(mutex_);
  if (index) indices_[want.tile] = index;
  if (loaded.failure) return loaded;
  if (loaded.chunk) {
    ++counts_.read;
    cache_.put({want.tile, *want.chunk}, loaded.chunk, loaded.chunk->bytes());
  } else {
    ++counts_.indices;
    loaded.index = index;
  }
  return loaded;
}

}  // namespace relief
