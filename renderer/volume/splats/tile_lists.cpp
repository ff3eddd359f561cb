#include "renderer/volume/splats/tile_lists.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace relief {
namespace {

/// The first and last of `low` to `high` whose middle is within `reach` of `at`.
void narrow(double at, double reach, std::int64_t& low, std::int64_t& high) {
  // In floating point until it is known to lie in the image: a footprint may reach very far.
  const double first = std::ceil(at - reach - 0.5);
  const double last = std::floor(at + reach - 0.5);
  if (first > static_cast<double>(high) || last < static_cast<double>(low)) {
    high = low - 1;
    return;
  }
  if (first > static_cast<double>(low)) low = static_cast<std::int64_t>(first);
  if (last < static_cast<double>(high)) high = static_cast<std::int64_t>(last);
}

}  // namespace

PixelBox Tiling::box(std::size_t tile) const {
  const auto t = static_cast<std::int64_t>(tile);
  const std::int64_t left = t % columns() * kTile;
  const std::int64_t top = t / columns() * kTile;
  return {left, std::min(left + kTile, width) - 1, top, std::min(top + kTile, height) - 1};
}

PixelBox pixels_of(const Footprint& footprint, std::int64_t image_height, const PixelBox& within) {
  PixelBox box = within;
  narrow(footprint.centre.x, footprint.reach.x, box.left, box.right);
  narrow(static_cast<double>(image_height) - footprint.centre.y, footprint.reach.y, box.top,
         box.bottom);
  return box;
}

PixelBox tiles_of(const Footprint& footprint, const Tiling& tiling) {
  const PixelBox box =
      pixels_of(footprint, tiling.height, {0, tiling.width - 1, 0, tiling.height - 1});
  if (box.is_empty()) return {};
  return {box.left / kTile, box.right / kTile, box.top / kTile, box.bottom / kTile};
}

TileLists::TileLists(const Tiling& tiling, std::span<const PlacedSplat> splats,
                     const SplatOrder& order)
    : starts_(tiling.count() + 1, 0) {
  std::vector<PixelBox> reached(splats.size());
  tbb::parallel_for(std::size_t{0}, splats.size(),
                    [&](std::size_t s) { reached[s] = tiles_of(splats[s].footprint, tiling); });
  const auto for_each_tile = [&](const OrderedSplat& ordered, const auto& visit) {
    const PixelBox& tiles = reached[ordered.splat];
    for (std::int64_t row = tiles.top; row <= tiles.bottom; ++row) {
      for (std::int64_t column = tiles.left; column <= tiles.right; ++column)
        visit(static_cast<std::size_t>(row * tiling.columns() + column));
    }
  };
  for (const OrderedSplat& ordered : order.splats)
    for_each_tile(ordered, [&](std::size_t tile) { ++starts_[tile + 1]; });
  for (std::size_t t = 1; t < starts_.size(); ++t) starts_[t] += starts_[t - 1];
  entries_.resize(starts_.back());
  std::vector<std::size_t> next(starts_.begin(), starts_.end() - 1);
  for (const OrderedSplat& ordered : order.splats)
    for_each_tile(ordered, [&](std::size_t tile) { entries_[next[tile]++] = ordered; });
}

}  // namespace relief
