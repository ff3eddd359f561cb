#include "renderer/engines/volume/cpu/tiles.h"

#include <tbb/parallel_for.h>

#include <algorithm>
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

/// Each tile's splats, in their order: where in `all` they are.
class Lists {
 public:
  Lists(std::span<const Splat> all, std::span<const Piece> pieces, const TileGrid& tiling)
      : starts_(tiling.count() + 1, 0) {
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
          splats_[next[p][tile]++] = static_cast<std::uint32_t>(&splat - all.data());
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

}  // namespace

Box TileGrid::box(std::size_t tile) const {
  const auto t = static_cast<int>(tile);
  const int left = t % columns() * kSide;
  const int top = t / columns() * kSide;
  return {left, std::min(left + kSide, width) - 1, top, std::min(top + kSide, height) - 1};
}

Tiles::Tiles(std::uint32_t width, std::uint32_t height, const CompositeRule& rule, bool has_layers)
    : tiling_{static_cast<int>(width), static_cast<int>(height)},
      rule_(rule),
      has_layers_(has_layers),
      is_open_(tiling_.count(), 1) {
  pixels_.reserve(tiling_.count());
  for (std::size_t t = 0; t < tiling_.count(); ++t) pixels_.push_back(open_tile(tiling_.box(t)));
}

bool Tiles::is_open(const Box& box) const {
  bool open = false;
  for_each_tile(box, tiling_, [&](std::size_t tile) { open = open || is_open_[tile] != 0; });
  return open;
}

bool Tiles::is_any_open() const {
  return std::ranges::find(is_open_, 1) != is_open_.end();
}

void Tiles::put_behind(std::span<const Splat> splats, std::span<const Piece> pieces,
                       const Progress& progress) {
  const Lists lists(splats, pieces, tiling_);
  tbb::parallel_for(std::size_t{0}, tiling_.count(), [&](std::size_t tile) {
    const auto list = lists.of(tile);
    if (is_open_[tile] == 0 || list.empty() || progress.cancelled()) return;
    composite(splats, list, tile);
  });
}

void Tiles::composite(std::span<const Splat> splats, std::span<const std::uint32_t> list,
                      std::size_t tile) {
  /// Splats after which it is looked whether anything is still open.
  constexpr std::size_t kLook = 32;
  const Box box = tiling_.box(tile);
  TilePixels& pixels = pixels_[tile];
  TileLayer layer;
  Box touched;
  for (std::size_t e = 0; e < list.size(); ++e) {
    const Splat& splat = splats[list[e]];
    bool looks = e % kLook == kLook - 1;
    if (has_layers_) {
      cpu::add(splat, box, layer);
      touched = united(touched, splat.box);
      looks = e + 1 == list.size() || splats[list[e + 1]].group != splat.group;
      if (!looks) continue;
      looks = !cpu::put_behind(touched, box, rule_, layer, pixels);
      touched = {};
    } else {
      cpu::put_behind(splat, box, rule_, pixels);
    }
    if (!looks || cpu::is_open(pixels)) continue;
    is_open_[tile] = 0;
    return;
  }
}

std::vector<glm::vec4> Tiles::rows() const {
  const auto width = static_cast<std::size_t>(tiling_.width);
  std::vector<glm::vec4> rows(width * static_cast<std::size_t>(tiling_.height));
  tbb::parallel_for(std::size_t{0}, tiling_.count(), [&](std::size_t tile) {
    const Box box = tiling_.box(tile);
    const TilePixels& pixels = pixels_[tile];
    for (int y = box.top; y <= box.bottom; ++y) {
      const auto from_bottom = static_cast<std::size_t>(tiling_.height - 1 - y);
      glm::vec4* row = &rows[from_bottom * width + static_cast<std::size_t>(box.left)];
      std::size_t i = place_of(0, y - box.top);
      for (int x = box.left; x <= box.right; ++x, ++i)
        *row++ = {pixels.red[i], pixels.green[i], pixels.blue[i], pixels.transmittance[i]};
    }
  });
  return rows;
}

}  // namespace relief::volume::cpu
