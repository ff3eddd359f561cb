// Which splats reach which part of an image.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "renderer/volume/splats/splat_order.h"

namespace relief {

/// Pixels along each side of a tile: its sums, 50 bytes a pixel, stay in a core's first cache.
inline constexpr std::int64_t kTile = 16;

/// Pixels of an image, row by row from the top: both ends included.
struct PixelBox {
  std::int64_t left = 0;
  std::int64_t right = -1;
  std::int64_t top = 0;
  std::int64_t bottom = -1;

  [[nodiscard]] bool is_empty() const { return left > right || top > bottom; }
};

/// The tiles of an image, row by row from the top.
struct Tiling {
  std::int64_t width = 0;  ///< pixels
  std::int64_t height = 0;

  [[nodiscard]] std::int64_t columns() const { return (width + kTile - 1) / kTile; }
  [[nodiscard]] std::int64_t rows() const { return (height + kTile - 1) / kTile; }
  [[nodiscard]] std::size_t count() const { return static_cast<std::size_t>(columns() * rows()); }
  [[nodiscard]] PixelBox box(std::size_t tile) const;
};

/// The pixels among `within` whose middles the footprint's box holds.
[[nodiscard]] PixelBox pixels_of(const Footprint& footprint, std::int64_t image_height,
                                 const PixelBox& within);

/// The tiles that the footprint's box reaches, as columns and rows of tiles; empty if none.
[[nodiscard]] PixelBox tiles_of(const Footprint& footprint, const Tiling& tiling);

/// Each tile's splats, in the order of the image's.
class TileLists {
 public:
  TileLists(const Tiling& tiling, std::span<const PlacedSplat> splats, const SplatOrder& order);

  [[nodiscard]] std::span<const OrderedSplat> list(std::size_t tile) const {
    return std::span(entries_).subspan(starts_[tile], starts_[tile + 1] - starts_[tile]);
  }

 private:
  std::vector<std::size_t> starts_;
  std::vector<OrderedSplat> entries_;
};

}  // namespace relief
