// The parts of an image in which FLIP can be above 0.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/compare/colour_errors.h"

namespace relief {

/// Pixels from (x, y), the upper left, `width` to the right and `height` downwards.
struct FlipTile {
  std::uint32_t x = 0;
  std::uint32_t y = 0;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
};

/// Returns disjoint tiles that hold every pixel within `reach` pixels, along x and along y, of one
/// whose colours differ. Filters that reach no farther see the same two images at all other pixels.
[[nodiscard]] std::vector<FlipTile> find_differing_tiles(const LinearColour& test,
                                                         const LinearColour& reference,
                                                         std::size_t reach);

}  // namespace relief
