#include "loader/stream/streamed_patches.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <set>
#include <utility>

#include "common/transform.h"
#include "loader/stream/choose_within.h"
#include "renderer/frame/image_parts.h"

namespace relief {
namespace {

/// What a chunk counts for in the mean.
constexpr double kShareOfNews = 0.1;

/// Of each kind of memory this much is used: chunks come and go, and leave gaps.
constexpr double kFill = 0.88;
/// It is less if there are more gaps than that.
constexpr double kLessFill = 0.95;
constexpr double kLeastFill = 0.6;
constexpr double kMoreFill = 1.01;

/// Samples that are read before the first picture.
constexpr std::uint64_t kMostFirstSamples = 200'000;

/// What could not be read is tried again after some time.
constexpr double kRetrySeconds = 5.0;

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

auto key_of(const Want& want) {
  return std::pair(want.tile, want.chunk);
}

double distance_between(const glm::dvec3& p, const Bounds& box) {
  return glm::distance(p, glm::clamp(p, box.min, box.max));
}

bool is_overview(const TreeTile& tile) {
  return tile.level > 0;
}

/// About as many as the patches of all tiles have.
double nodes_of(const TileSource& source) {
  double nodes = 0.0;
  for (const TreeTile& tile : source.tiles())
    nodes += source.kind().nodes_a_sample * static_cast<double>(tile.samples);
  return nodes;
}

/// Overviews have one normal and one colour a sample. Of a file without any: that of its patches.
PatchKind kind_of_overviews(const TileSource& source) {
  const bool has_some = std::ranges::any_of(source.tiles(), &is_overview);
  return has_some ? PatchKind{source.kind().nodes_a_sample, 1, 1} : source.kind();
}

}  // namespace

StreamedPatches::StreamedPatches(const Gl& gl, std::shared_ptr<TileSource> source,
                                 const StoreNeeds& needs, const StreamBudget& budget,
                                 std::function<void()> wake)
    : source_(std::move(source)),
      pool_(gl, needs,
            {.body = {source_->box(), {}},
             .is_closed = source_->scene().patches.is_closed,
             .nearest_colours = source_->scene().patches.has_label_colours}),
      loader_(source_, needs, store_limits(gl),
              {budget.memory / 4, budget.memory - budget.memory / 4}, std::move(wake)),
      indices_(source_->tiles().size()),
      cost_of_finest_(usual_cost_a_node(source_->kind(), needs)),
      cost_of_overviews_(usual_cost_a_node(kind_of_overviews(*source_), needs)),
      room_(divide_budget(budget.gpu, cost_of_finest_, cost_of_overviews_, nodes_of(*source_))),
      fill_(kFill) {}

Result<std::unique_ptr<StreamedPatches>> StreamedPatches::create(
    const Gl& gl, std::shared_ptr<TileSource> source, const StoreNeeds& needs,
    const StreamBudget& budget, std::span<const RenderSettings> views, std::function<void()> wake) {
  std::unique_ptr<StreamedPatches> made(
      new StreamedPatches(gl, std::move(source), needs, budget, std::move(wake)));
  made->choose(views);
  RELIEF_TRY(made->load_roots());
  made->make_cut();
  made->show();
  made->ask();
  return made;
}

Status StreamedPatches::load_roots() {
  std::uint64_t samples = 0;
  const std::span<const TreeTile> tiles = source_->tiles();
  for (std::uint32_t t = 0; t < tiles.size() && samples < kMostFirstSamples; ++t) {
    if (tiles[t].parent != kNoTile) continue;
    Loaded index = loader_.load({t, std::nullopt, 0});
    if (index.failure) return Error{*index.failure};
    take(index);
    for (std::uint32_t c = 0; c < index.index->chunks.size() && samples < kMostFirstSamples; ++c) {
      Loaded chunk = loader_.load({t, c, 0});
      if (chunk.failure) return Error{*chunk.failure};
      add({t, c}, *chunk.chunk);
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
      .finest = [this](ChunkKey key) -> std::optional<std::uint32_t> {
        const auto there = residents_.find(key);
        if (there == residents_.end()) return std::nullopt;
        return there->second.finest;
      },
      .needed = [this](const ChunkInfo& chunk) { return needed_level(chunk); },
      .sees = [this](const Bounds& box,
                     double spacing) { return is_in_view(onlookers_, box, spacing); },
      .distance = [&eye](const Bounds& box) { return distance_between(eye, box); }};
  return relief::make_cut(source_->tiles(), path, state);
}

/// kUsualFinest if no view shows a finer level of any of its patches, otherwise 0.
std::uint32_t StreamedPatches::needed_level(const ChunkInfo& chunk) const {
  if (chunk.is_joined) return 0;
  const double spacing = std::ldexp(chunk.spacing, kUsualFinest);
  for (std::size_t k = 0; k < onlookers_.size(); ++k) {
    const Onlooker& onlooker = onlookers_[k];
    const glm::dvec3 centre = moved(onlooker.transform, 0.5 * (chunk.box.min + chunk.box.max));
    const double scale = onlooker.transform.scale;
    const double radius = 0.5 * scale * glm::distance(chunk.box.min, chunk.box.max);
    if (scale * spacing > level_pixels_[k] * nearest_pixel(onlooker.view, centre, radius)) return 0;
  }
  return kUsualFinest;
}

/// Of the chunks of a tile in view; 0 if they are not known yet.
ChunkCost StreamedPatches::cost_in_view(std::uint32_t tile) const {
  ChunkCost sum;
  const TileIndex* const index = index_of(tile);
  for (std::uint32_t c = 0; index != nullptr && c < index->chunks.size(); ++c) {
    const ChunkInfo& chunk = index->chunks[c];
    if (!is_in_view(onlookers_, chunk.box, chunk.spacing)) continue;
    const auto nodes = static_cast<double>(chunk.nodes);
    const auto known = costs_.find({tile, c});
    if (known == costs_.end()) {
      sum += nodes * (is_overview(source_->tiles()[tile]) ? cost_of_overviews_ : cost_of_finest_);
    } else {
      sum += known->second.cost;
      if (needed_level(chunk) < known->second.finest) sum.rest += kFinestBytesANode * nodes;
    }
  }
  return sum;
}

void StreamedPatches::choose(std::span<const RenderSettings> views) {
  const std::vector<Onlooker> before = std::exchange(
      onlookers_, onlookers_of(views, {&source_->where(), 1}, source_->scene().patches));
  const bool moves = before.size() != onlookers_.size() ||
                     before.front().view.eye != onlookers_.front().view.eye ||
                     before.front().view.rotation != onlookers_.front().view.rotation;
  // Gaps close as chunks go. Not at rest: the picture would change back and forth.
  if (moves) fill_ = std::min(fill_ * kMoreFill, kFill);
  level_pixels_.clear();
  for (const RenderSettings& view : views)
    level_pixels_.push_back(pixels_per_sample_of(view) / samples_a_side(view.samples));
}

/// As fine as the views ask for, or coarser where that does not fit the budget. What is not known
/// yet of tiles is asked for before it is found out how much that is.
void StreamedPatches::make_cut() {
  const std::span<const TreeTile> tiles = source_->tiles();
  const std::vector<std::uint32_t> goal = choose_tiles(tiles, onlookers_);
  ChunkCost sum;
  const ChunkCost room = fill_ * room_;
  const std::vector<std::uint32_t> chosen = choose_within(
      tiles, goal,
      [&](std::uint32_t t) { return coarseness(onlookers_, tiles[t].box, tiles[t].spacing); },
      [&](std::span<const std::uint32_t> more) {
        ChunkCost with = sum;
        for (const std::uint32_t t : more) with += cost_in_view(t);
        const bool fit = with.fits(room);
        if (fit || more.empty() || tiles[more.front()].parent == kNoTile) sum = with;
        return fit;
      });
  is_coarser_ = chosen != goal;
  cut_ = cut_for(path_to(tiles, chosen));
  if (is_coarser_) {
    for (const std::uint32_t t : path_to(tiles, goal).tiles) {
      const Want index{t, std::nullopt, 0};
      if (index_of(t) == nullptr && std::ranges::find(cut_.wanted, index) == cut_.wanted.end())
        cut_.wanted.push_back(index);
    }
  }
  const double now = seconds();
  std::erase_if(failed_, [now](const auto& f) { return now - f.second > kRetrySeconds; });
  std::erase_if(cut_.wanted, [this](const Want& want) { return failed_.contains(key_of(want)); });
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
  // Not before the first picture: a texture of the budget's size takes 80 ms where OpenGL runs on
  // the CPU.
  if (!has_room_ && updates_ > 1) {
    const auto reserved = pool_.reserve(room_.maps);
    // If there is less memory than the budget, adding chunks will say so.
    has_room_ = !reserved || *reserved;
  }
  bool has_more = false;
  while (has_room_ && (!has_more || 1000.0 * (seconds() - start) < ms)) {
    std::optional<Loaded> loaded = loader_.take();
    if (!loaded) break;
    has_more |= take(*std::move(loaded));
  }
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
  const auto before = residents_.find(key);
  if (before != residents_.end() && before->second.finest <= chunk.finest) return false;
  const auto nodes = static_cast<double>(indices_[key.tile]->chunks[key.chunk].nodes);
  ChunkCost& mean = is_overview(source_->tiles()[key.tile]) ? cost_of_overviews_ : cost_of_finest_;
  mean = (1.0 - kShareOfNews) * mean;
  mean += kShareOfNews / nodes * cost_of(chunk);
  if (make_room(chunk)) return add(key, chunk);
  // The next cut is coarser, and may have no more need of it.
  failed_[key_of({key.tile, key.chunk, 0})] = seconds();
  return true;
}

bool StreamedPatches::add(ChunkKey key, const PatchChunk& chunk) {
  const ChunkCost cost = cost_of(chunk);
  costs_[key] = {cost, chunk.finest};
  const auto slot = pool_.add(chunk);
  if (!slot) {
    // There is less memory than the budget: do with what there is.
    fill_less();
    fail({key.tile, key.chunk, 0}, slot.error().message);
    return true;
  }
  if (const auto coarser = residents_.find(key); coarser != residents_.end()) drop(coarser);
  residents_[key] = {*slot, ++uploads_, cost.rest, updates_, chunk.finest, chunk.boxes};
  resident_rest_ += cost.rest;
  return true;
}

/// Drops what was not seen for longest until the chunk fits. Whether it does.
bool StreamedPatches::make_room(const PatchChunk& chunk) {
  const double rest = cost_of(chunk).rest;
  while (!pool_.has_room(chunk) || resident_rest_ + rest > room_.rest) {
    const auto oldest = std::ranges::min_element(
        residents_, {}, [](const auto& resident) { return resident.second.last_seen; });
    if (oldest == residents_.end() || oldest->second.last_seen == updates_) {
      fill_less();
      return false;
    }
    drop(oldest);
  }
  return true;
}

/// Once in an update, however many chunks find no room.
void StreamedPatches::fill_less() {
  if (std::exchange(less_filled_, updates_) == updates_) return;
  fill_ = std::max(fill_ * kLessFill, kLeastFill);
}

void StreamedPatches::drop(std::map<ChunkKey, Resident>::iterator resident) {
  pool_.remove(resident->second.slot);
  resident_rest_ -= resident->second.rest;
  residents_.erase(resident);
}

bool StreamedPatches::show() {
  std::vector<std::uint64_t> numbers;
  for (const CutPart& part : cut_.shown) numbers.push_back(residents_.at(part.key).number);
  if (numbers == shown_numbers_ && cut_.shown == shown_) return false;
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
  shown_numbers_ = std::move(numbers);
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
  state.is_coarser = is_coarser_;
  state.gpu_bytes = pool_.bytes();
  state.cached_bytes = loader_.cached_bytes();
  state.counts = loader_.counts();
  return state;
}

}  // namespace relief
