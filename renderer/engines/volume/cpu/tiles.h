// The tiles of an image, into which batches of splats are composited.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "common/progress.h"
#include "renderer/engines/volume/cpu/tile.h"

namespace relief::volume::cpu {

/// The tiles of an image, row by row from the top.
struct TileGrid {
  int width = 0;  ///< pixels
  int height = 0;

  [[nodiscard]] int columns() const { return (width + kSide - 1) / kSide; }
  [[nodiscard]] std::size_t count() const {
    return static_cast<std::size_t>(columns()) *
           static_cast<std::size_t>((height + kSide - 1) / kSide);
  }
  [[nodiscard]] Box box(std::size_t tile) const;
};

/// Splats of a batch that were found as one piece of work.
class Piece {
 public:
  Piece() = default;
  /// Room for some splats, and for the surfaces of each or of none.
  Piece(std::span<Splat> splats, std::span<SplatSurface> surfaces)
      : splats_(splats), surfaces_(surfaces) {}

  [[nodiscard]] bool has_surfaces() const { return !surfaces_.empty(); }
  void add(const Splat& splat) { splats_[count_++] = splat; }
  void add(const Splat& splat, const SplatSurface& surface) {
    surfaces_[count_] = surface;
    add(splat);
  }
  [[nodiscard]] std::span<const Splat> splats() const { return splats_.first(count_); }

 private:
  std::span<Splat> splats_;
  std::span<SplatSurface> surfaces_;
  std::size_t count_ = 0;
};

/// Splats front to back, in pieces that lie in the arrays.
struct Batch {
  std::vector<Splat> splats;
  std::vector<SplatSurface> surfaces;  ///< of each splat, or empty
  std::vector<Piece> pieces;

  [[nodiscard]] const SplatSurface* surface(std::size_t splat) const {
    return surfaces.empty() ? nullptr : &surfaces[splat];
  }
};

/// What is composited.
struct TilesRule {
  CompositeRule compositing;
  bool has_layers = false;    ///< splats of one group are one layer; otherwise each is one
  bool has_surfaces = false;  ///< normals and depths are kept
  /// Depths at which what each pixel shows ends (row-major, the top row first), or none. Negative
  /// infinite: nothing is shown.
  std::span<const float> limits = {};
};

class Tiles {
 public:
  /// Of an image of that many pixels.
  Tiles(std::uint32_t width, std::uint32_t height, const TilesRule& rule);

  /// Whether some pixel of a box of the image may show more. Thread-safe while nothing is put
  /// behind.
  [[nodiscard]] bool is_open(const Box& box) const;
  [[nodiscard]] bool is_any_open() const;

  /// Whether splats have surfaces.
  [[nodiscard]] bool needs_surfaces() const { return has_surfaces() || !limits_.empty(); }
  [[nodiscard]] bool has_surfaces() const { return !surfaces_.empty(); }

  /// Puts splats behind what the image shows.
  void put_behind(const Batch& batch, const Progress& progress);

  /// Colour times opacity and the transmittance of each pixel, the bottom row first.
  [[nodiscard]] std::vector<glm::vec4> colours() const;
  /// The sum of normals and the depth of each pixel, likewise. Of tiles that have surfaces.
  [[nodiscard]] std::vector<glm::vec4> surfaces() const;

 private:
  void composite(const Batch& batch, std::span<const std::uint32_t> list, std::size_t tile);

  TileGrid tiling_;
  CompositeRule rule_;
  bool has_layers_;
  std::vector<TilePixels> pixels_;
  std::vector<TileSurfaces> surfaces_;  ///< of each tile, or empty
  std::vector<TileFloats> limits_;      ///< likewise
  std::vector<std::uint8_t> is_open_;
};

}  // namespace relief::volume::cpu
