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
  explicit Piece(std::span<Splat> space) : space_(space) {}

  void add(const Splat& splat) { space_[count_++] = splat; }
  [[nodiscard]] std::span<const Splat> splats() const { return space_.first(count_); }

 private:
  std::span<Splat> space_;
  std::size_t count_ = 0;
};

class Tiles {
 public:
  /// Of an image of that many pixels. `has_layers`: splats of one group are one layer; otherwise
  /// each is one.
  Tiles(std::uint32_t width, std::uint32_t height, const CompositeRule& rule, bool has_layers);

  /// Whether some pixel of a box of the image may show more. Thread-safe while nothing is put
  /// behind.
  [[nodiscard]] bool is_open(const Box& box) const;
  [[nodiscard]] bool is_any_open() const;

  /// Puts pieces, front to back, behind what the image shows. All lie in `splats`.
  void put_behind(std::span<const Splat> splats, std::span<const Piece> pieces,
                  const Progress& progress);

  /// Colour times opacity and the transmittance of each pixel, the bottom row first.
  [[nodiscard]] std::vector<glm::vec4> rows() const;

 private:
  void composite(std::span<const Splat> splats, std::span<const std::uint32_t> list,
                 std::size_t tile);

  TileGrid tiling_;
  CompositeRule rule_;
  bool has_layers_;
  std::vector<TilePixels> pixels_;
  std::vector<std::uint8_t> is_open_;
};

}  // namespace relief::volume::cpu
