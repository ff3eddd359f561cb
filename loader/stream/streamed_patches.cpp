#include "loader/stream/streamed_patches.h"

#include <algorithm>
#include <chrono>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <set>
#include <utility>

namespace relief {
namespace {

/// A guess before the first chunk: normals, colours at two texels a cell, levels of cells.
constexpr double kFirstBytesANode = 32.0;
/// What a chunk counts for in the mean.
constexpr double kShareOfNews = 0.1;

/// The pool's arrays grow ahead of what is in them.
constexpr double kShareOfBudget = 0.75;

/// What a view needs may be made coarser by so much at each try.
constexpr double kCoarserStep = 1.2;
constexpr int kMostSteps = 64;

/// Samples that are read before the first picture.
constexpr std::uint64_t kMostFirstSamples = 200'000;

/// What could not be read is tried again after some time.
constexpr double kRetrySeconds = 5.0;

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

auto key_of(const Want& want) {
  return std::pair(want.tile, want.chunk);
}

double distance_between(const glm::dvec3& p, const Bounds& box) {
  return glm::distance(p, glm::clamp(p, box.min, box.max));
}

}  // namespace

StreamedPatches::StreamedPatches(const Gl& gl, std::shared_ptr<TileSource> source,
                                 const StoreNeeds& needs, const StreamBudget& budget,
                                 std::function<void()> wake)
    : source_(std::move(source)),
      budget_(budget),
      pool_(gl, needs,
            {.body = {source_->box(), {}}, .is_closed = source_->scene().patches.is_closed}),
      loader_(source_, needs, store_limits(gl), {budget.memory / 4, budget.memory - budget.memory / 4},
              std::move(wake)),
      indices_(source_->tiles().size()),
      bytes_a_node_(kFirstBytesANode) {}

Result<std::unique_ptr<StreamedPatches>> StreamedPatches::create(
    const Gl& gl, std::shared_ptr<TileSource> source, const StoreNeeds& needs,
    const StreamBudget& budget, std::span<const RenderSettings> views, std::function<void()> wake) {
  std::unique_ptr<StreamedPatches> made(
      new StreamedPatches(gl, std::move(source), needs, budget, std::move(wake)));
  made->choose(views);
  RELIEF_TRY(made->load_roots());
  made->update(views, 0.0);
  return made;
}

Status StreamedPatches::load_roots() {
  std::uint64_t samples = 0;
  const std::span<const TreeTile> tiles = source_->tiles();
  for (std::uint32_t t = 0; t < tiles.size() && samples < kMostFirstSamples; ++t) {
    if (tiles[t].parent != kNoTile || !is_in_view(onlookers_, tiles[t].box, tiles[t].spacing))
      continue;
    Loaded index = loader_.load({t, std::nullopt});
    if (index.failure) return Error{*index.failure};
    take(index);
    for (std::uint32_t c = 0; c < index.index->chunks.size() && samples < kMostFirstSamples; ++c) {
      Loaded chunk = loader_.load({t, c});
      if (chunk.failure) return Error{*chunk.failure};
      upload({t, c}, *chunk.chunk);
      samples += index.index->chunks[c].samples;
    }
  }
  return {};
}

const TileIndex* StreamedPatches::index_of(std::uint32_t tile) const {
  return indices_[tile].get();
}

Cut StreamedPatches::cut_for(const TilePath& path) const {
  const Onlooker& first = onlookers_.front();
  const glm::dvec3 eye = glm::transpose(first.transform.rotation) *
                         (first.view.eye - first.transform.translation) / first.transform.scale;
  const CutState state{
      .index = [this](std::uint32_t tile) { return index_of(tile); },
      .is_there = [this](ChunkKey key) { return residents_.contains(key); },
      .sees = [this](const Bounds& box,
                     double spacing) { return is_in_view(onlookers_, box, spacing); },
      .distance = [&eye](const Bounds& box) { return distance_between(eye, box); }};
  return relief::make_cut(source_->tiles(), path, state);
}

std::uint64_t StreamedPatches::bytes_of(const Cut& cut) const {
  double bytes = 0.0;
  for (const ChunkKey key : cut.seen) {
    const auto known = bytes_.find(key);
    bytes += known != bytes_.end()
                 ? static_cast<double>(known->second)
                 : bytes_a_node_ *
                       static_cast<double>(index_of(key.tile)->chunks[key.chunk].nodes);
  }
  return static_cast<std::uint64_t>(bytes);
}

void StreamedPatches::choose(std::span<const RenderSettings> views) {
  onlookers_ = onlookers_of(views, {&source_->where(), 1}, source_->scene().patches);
}

/// As fine as the views ask for, or coarser until it fits the budget. What is not known yet of
/// tiles is asked for before it is found out how much that is.
void StreamedPatches::make_cut() {
  const std::vector<Onlooker> asked = onlookers_;
  const auto limit =
      static_cast<std::uint64_t>(kShareOfBudget * static_cast<double>(budget_.gpu));
  coarser_ = 1.0;
  std::vector<Want> unknown;
  for (int step = 0; step < kMostSteps; ++step, coarser_ *= kCoarserStep) {
    for (std::size_t k = 0; k < asked.size(); ++k)
      onlookers_[k].pixels = asked[k].pixels * coarser_;
    cut_ = cut_for(path_to(source_->tiles(), choose_tiles(source_->tiles(), onlookers_)));
    if (step == 0) {
      std::copy_if(cut_.wanted.begin(), cut_.wanted.end(), std::back_inserter(unknown),
                   [](const Want& want) { return !want.chunk; });
    }
    if (bytes_of(cut_) <= limit) break;
  }
  onlookers_ = asked;
  for (const Want& want : unknown) {
    if (std::ranges::find(cut_.wanted, want) == cut_.wanted.end()) cut_.wanted.push_back(want);
  }
  const double now = seconds();
  std::erase_if(failed_, [now](const auto& f) { return now - f.second > kRetrySeconds; });
  std::erase_if(cut_.wanted,
                [this](const Want& want) { return failed_.contains(key_of(want)); });
  for (const ChunkKey key : cut_.seen) {
    if (const auto there = residents_.find(key); there != residents_.end())
      there->second.last_seen = updates_;
  }
}

bool StreamedPatches::update(std::span<const RenderSettings> views, double ms) {
  const double start = seconds();
  ++updates_;
  choose(views);
  make_cut();
  bool has_more = false;
  do {
    std::optional<Loaded> loaded = loader_.take();
    if (!loaded) break;
    has_more |= take(*std::move(loaded));
  } while (1000.0 * (seconds() - start) < ms);
  if (has_more) make_cut();
  const bool changes = show();
  ask();
  return changes;
}

/// Whether the cut may be another one now.
bool StreamedPatches::take(Loaded loaded) {
  if (loaded.failure) {
    fail(loaded.want, *std::move(loaded.failure));
    return true;
  }
  if (loaded.index) {
    indices_[loaded.want.tile] = std::move(loaded.index);
    return true;
  }
  const ChunkKey key{loaded.want.tile, *loaded.want.chunk};
  // The view may have gone on; the loader's cache has it still.
  if (std::ranges::find(cut_.seen, key) == cut_.seen.end()) return false;
  return upload(key, *loaded.chunk);
}

bool StreamedPatches::upload(ChunkKey key, const PatchChunk& chunk) {
  if (residents_.contains(key)) return false;
  const std::uint64_t bytes = chunk.bytes();
  const auto nodes = static_cast<double>(indices_[key.tile]->chunks[key.chunk].nodes);
  bytes_[key] = bytes;
  bytes_a_node_ += kShareOfNews * (static_cast<double>(bytes) / nodes - bytes_a_node_);
  if (!make_room(bytes)) {
    failed_[{key.tile, key.chunk}] = seconds();
    return true;
  }
  const auto slot = pool_.add(chunk);
  if (!slot) {
    // There is less memory than the budget: do with what there is.
    budget_.gpu = std::max<std::uint64_t>(resident_bytes_, 1);
    fail({key.tile, key.chunk}, slot.error().message);
    return true;
  }
  residents_[key] = {*slot, bytes, updates_, chunk.boxes};
  resident_bytes_ += bytes;
  return true;
}

/// Drops what was not seen for longest. Whether there is room.
bool StreamedPatches::make_room(std::uint64_t bytes) {
  const auto limit = static_cast<std::uint64_t>(0.8 * static_cast<double>(budget_.gpu));
  while (resident_bytes_ + bytes > limit) {
    const auto oldest = std::ranges::min_element(
        residents_, {}, [](const auto& resident) { return resident.second.last_seen; });
    if (oldest == residents_.end() || oldest->second.last_seen == updates_) return false;
    pool_.remove(oldest->second.slot);
    resident_bytes_ -= oldest->second.bytes;
    residents_.erase(oldest);
  }
  return true;
}

bool StreamedPatches::show() {
  if (cut_.shown == shown_) return false;
  std::vector<ShownChunk> chunks;
  for (const CutPart& part : cut_.shown) {
    const Resident& resident = residents_.at(part.key);
    ShownChunk shown{resident.slot};
    if (!part.gaps.empty()) {
      for (const Bounds& box : resident.boxes) {
        shown.hidden.push_back(std::ranges::none_of(
            part.gaps, [&box](const Bounds& gap) { return overlap(box, gap); }));
      }
    }
    chunks.push_back(std::move(shown));
  }
  pool_.show(chunks);
  shown_ = cut_.shown;
  return true;
}

void StreamedPatches::ask() {
  if (cut_.wanted == asked_) return;
  asked_ = cut_.wanted;
  loader_.want(asked_);
}

void StreamedPatches::fail(const Want& want, std::string message) {
  failed_[key_of(want)] = seconds();
  if (std::ranges::find(known_failures_, message) != known_failures_.end()) return;
  known_failures_.push_back(message);
  failures_.push_back(std::move(message));
}

std::vector<std::string> StreamedPatches::take_failures() {
  return std::exchange(failures_, {});
}

StreamState StreamedPatches::state() const {
  StreamState state;
  state.tiles = source_->tiles().size();
  std::set<std::uint32_t> tiles;
  for (const CutPart& part : shown_) {
    tiles.insert(part.key.tile);
    if (part.gaps.empty())
      state.shown_samples += index_of(part.key.tile)->chunks[part.key.chunk].samples;
  }
  state.shown_tiles = tiles.size();
  state.waiting = cut_.wanted.size();
  state.coarser = coarser_;
  state.gpu_bytes = pool_.bytes();
  state.cached_bytes = loader_.cached_bytes();
  state.counts = loader_.counts();
  return state;
}

}  // namespace relief
