#include "renderer/engines/volume/cpu/tiles.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

namespace relief::volume::cpu {
namespace {

template <class Visit>
void for_each_tile(const Box& box, const TileGrid& tiling, const Visit& visit) {
  const auto columns = static_cast<std::size_t>(tiling.columns());
  for (int row = box.top / kSide; row <= box.bottom / kSide; ++row) {
    for (int column = box.left / kSide; column <= box.right / kSide; ++column)
      visit(static_cast<std::size_t>(row) * columns + static_cast<std::size_t>(column));
  }
}

/// Each tile's splats, in their order.
class Lists {
 public:
  Lists(const Batch& batch, const TileGrid& tiling) : starts_(tiling.count() + 1, 0) {
    const std::vector<Piece>& pieces = batch.pieces;
    // By piece and tile: how many, then where the piece's own begin.
    std::vector<std::vector<std::uint32_t>> next(pieces.size());
    tbb::parallel_for(std::size_t{0}, pieces.size(), [&](std::size_t p) {
      next[p].assign(tiling.count(), 0);
      for (const Splat& splat : pieces[p].splats())
        for_each_tile(splat.box, tiling, [&](std::size_t tile) { ++next[p][tile]; });
    });
    std::uint32_t sum = 0;
    for (std::size_t tile = 0; tile < tiling.count(); ++tile) {
      starts_[tile] = sum;
      for (std::vector<std::uint32_t>& of_piece : next) sum += std::exchange(of_piece[tile], sum);
    }
    starts_.back() = sum;
    splats_.resize(sum);
    tbb::parallel_for(std::size_t{0}, pieces.size(), [&](std::size_t p) {
      for (const Splat& splat : pieces[p].splats()) {
        for_each_tile(splat.box, tiling, [&](std::size_t tile) {
          splats_[next[p][tile]++] = static_cast<std::uint32_t>(&splat - batch.splats.data());
        });
      }
    });
  }

  [[nodiscard]] std::span<const std::uint32_t> of(std::size_t tile) const {
    return std::span(splats_).subspan(starts_[tile], starts_[tile + 1] - starts_[tile]);
  }

 private:
  std::vector<std::uint32_t> starts_;  ///< by tile, and the end
  std::vector<std::uint32_t> splats_;
};

Box united(const Box& a, const Box& b) {
  if (a.is_empty()) return b;
  return {std::min(a.left, b.left), std::max(a.right, b.right), std::min(a.top, b.top),
          std::max(a.bottom, b.bottom)};
}

/// The image's rows, the bottom row first. `texel`: of a tile, by its index and the place in it.
template <class Texel>
std::vector<glm::vec4> rows_of(const TileGrid& tiling, const Texel& texel) {
  const auto width = static_cast<std::size_t>(tiling.width);
  std::vector<glm::vec4> rows(width * static_cast<std::size_t>(tiling.height));
  tbb::parallel_for(std::size_t{0}, tiling.count(), [&](std::size_t tile) {
    const Box box = tiling.box(tile);
    for (int y = box.top; y <= box.bottom; ++y) {
      const auto from_bottom = static_cast<std::size_t>(tiling.height - 1 - y);
      glm::vec4* row = &rows[from_bottom * width + static_cast<std::size_t>(box.left)];
      std::size_t i = place_of(0, y - box.top);
      for (int x = box.left; x <= box.right; ++x, ++i) *row++ = texel(tile, i);
    }
  });
  return rows;
}

}  // namespace

Box TileGrid::box(std::size_t tile) const {
  const auto t = static_cast<int>(tile);
  const int left = t % columns() * kSide;
  const int top = t / columns() * kSide;
  return {left, std::min(left + kSide, width) - 1, top, std::min(top + kSide, height) - 1};
}

Tiles::Tiles(std::uint32_t width, std::uint32_t height, const TilesRule& rule)
    : tiling_{static_cast<int>(width), static_cast<int>(height)},
      rule_(rule.compositing),
      has_layers_(rule.has_layers),
      is_open_(tiling_.count(), 1) {
  pixels_.reserve(tiling_.count());
  for (std::size_t t = 0; t < tiling_.count(); ++t) pixels_.push_back(open_tile(tiling_.box(t)));
  if (rule.has_surfaces) {
    surfaces_.resize(tiling_.count());
    for (TileSurfaces& shown : surfaces_) shown.depth.fill(std::numeric_limits<float>::infinity());
  }
  if (rule.limits.empty()) return;
  limits_.resize(tiling_.count());
  for (std::size_t t = 0; t < tiling_.count(); ++t) {
    const Box box = tiling_.box(t);
    for (int y = box.top; y <= box.bottom; ++y) {
      for (int x = box.left; x <= box.right; ++x) {
        const std::size_t place = place_of(x - box.left, y - box.top);
        const float limit =
            rule.limits[static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)];
        limits_[t][place] = limit;
        if (limit == -std::numeric_limits<float>::infinity()) pixels_[t].is_open[place] = 0.0F;
      }
    }
    is_open_[t] = cpu::is_open(pixels_[t]) ? 1 : 0;
  }
}

bool Tiles::is_open(const Box& box) const {
  bool open = false;
  for_each_tile(box, tiling_, [&](std::size_t tile) { open = open || is_open_[tile] != 0; });
  return open;
}

bool Tiles::is_any_open() const {
  return std::ranges::find(is_open_, 1) != is_open_.end();
}

void Tiles::put_behind(const Batch& batch, const Progress& progress) {
  const Lists lists(batch, tiling_);
  tbb::parallel_for(std::size_t{0}, tiling_.count(), [&](std::size_t tile) {
    const auto list = lists.of(tile);
    if (is_open_[tile] == 0 || list.empty() || progress.cancelled()) return;
    composite(batch, list, tile);
  });
}

void Tiles::composite(const Batch& batch, std::span<const std::uint32_t> list, std::size_t tile) {
  /// Splats after which it is looked whether anything is still open.
  constexpr std::size_t kLook = 32;
  const Box box = tiling_.box(tile);
  TilePixels& pixels = pixels_[tile];
  TileLayer layer;
  std::optional<TileSurfaces> layer_surfaces;
  TileExtras extras;
  if (!limits_.empty()) extras.limits = &limits_[tile];
  if (has_surfaces()) {
    extras.layer = &layer_surfaces.emplace();
    extras.shown = &surfaces_[tile];
  }
  Box touched;
  for (std::size_t e = 0; e < list.size(); ++e) {
    const Splat& splat = batch.splats[list[e]];
    const SplatSurface* const surface = batch.surface(list[e]);
    bool looks = e % kLook == kLook - 1;
    if (has_layers_) {
      cpu::add(splat, surface, box, extras, layer);
      touched = united(touched, splat.box);
      looks = e + 1 == list.size() || batch.splats[list[e + 1]].group != splat.group;
      if (!looks) continue;
      looks = !cpu::put_behind(touched, box, rule_, extras, layer, pixels);
      touched = {};
    } else {
      cpu::put_behind(splat, surface, box, rule_, extras, pixels);
    }
    if (!looks || cpu::is_open(pixels)) continue;
    is_open_[tile] = 0;
    return;
  }
}

std::vector<glm::vec4> Tiles::colours() const {
  return rows_of(tiling_, [this](std::size_t tile, std::size_t i) {
    const TilePixels& pixels = pixels_[tile];
    return glm::vec4(pixels.red[i], pixels.green[i], pixels.blue[i], pixels.transmittance[i]);
  });
}

std::vector<glm::vec4> Tiles::surfaces() const {
  return rows_of(tiling_, [this](std::size_t tile, std::size_t i) {
    const TileSurfaces& shown = surfaces_[tile];
    return glm::vec4(shown.normal_x[i], shown.normal_y[i], shown.normal_z[i], shown.depth[i]);
  });
}

}  // namespace relief::volume::cpu
