// A tile of an image into which splats are composited on the CPU, front to back.
#pragma once

#include <array>
#include <cstddef>

#include "renderer/engines/volume/cpu/splat.h"
#include "renderer/volume/splats/composite_rule.h"

namespace relief::volume::cpu {

/// An image of a tile's pixels (place_of()).
using TileFloats = std::array<float, kSide * kStride>;

/// The sums of a layer, empty between layers.
struct alignas(64) TileLayer {
  TileFloats weight{};
  TileFloats red{};
  TileFloats green{};
  TileFloats blue{};
};

/// What the pixels show, row by row from the top. What is beyond kSide means nothing.
struct alignas(64) TilePixels {
  TileFloats red{};  ///< times its opacity
  TileFloats green{};
  TileFloats blue{};
  TileFloats transmittance{};
  TileFloats is_open{};  ///< 1, or 0 where nothing more is seen
};

/// Normals and depths: sums of a layer, or what pixels show.
struct alignas(64) TileSurfaces {
  TileFloats normal_x{};
  TileFloats normal_y{};
  TileFloats normal_z{};
  TileFloats depth{};  ///< of what pixels show: where half of what is behind is covered
};

/// What a tile has beside colours, if anything.
struct TileExtras {
  const TileFloats* limits = nullptr;  ///< depths at which what pixels show ends
  TileSurfaces* layer = nullptr;       ///< both or none
  TileSurfaces* shown = nullptr;

  [[nodiscard]] bool is_any() const { return limits != nullptr || shown != nullptr; }
};

/// Nothing shown; open where the tile lies in the image.
[[nodiscard]] TilePixels open_tile(const Box& tile);

/// Adds a splat to a layer, in the part of its box that lies in `tile`. `surface`: for extras.
void add(const Splat& splat, const SplatSurface* surface, const Box& tile, const TileExtras& extras,
         TileLayer& layer);

/// Puts a layer behind what some pixels of the tile show [Zwicker 2002, Eq. (7) and (10)], and
/// empties it. Returns whether more is seen in one of them.
bool put_behind(const Box& touched, const Box& tile, const CompositeRule& rule,
                const TileExtras& extras, TileLayer& layer, TilePixels& pixels);

/// Puts a splat behind what the pixels show, as a layer of its own.
void put_behind(const Splat& splat, const SplatSurface* surface, const Box& tile,
                const CompositeRule& rule, const TileExtras& extras, TilePixels& pixels);

/// Whether something more is seen in a pixel.
[[nodiscard]] bool is_open(const TilePixels& pixels);

}  // namespace relief::volume::cpu
