// The weights of a splat in a tile, kLanes pixels of a row at once.
#pragma once

#include <algorithm>
#include <cstddef>

#include "renderer/engines/volume/cpu/lanes.h"
#include "renderer/engines/volume/cpu/splat.h"

namespace relief::volume::cpu {

static_assert(kSide + kLanes <= kStride);

/// The part of a box in a tile, from the tile's corner; ends excluded.
struct Part {
  int top = 0;
  int bottom = 0;
  int left = 0;
  int right = 0;
};

[[nodiscard]] inline Part part_of(const Box& box, const Box& tile) {
  return {std::max(box.top - tile.top, 0), std::min(box.bottom, tile.bottom) - tile.top + 1,
          std::max(box.left - tile.left, 0), std::min(box.right, tile.right) - tile.left + 1};
}

/// Runs of pixels that start at dx, in rows from dy on.
struct RunExponent {
  const Splat& splat;
  Floats dx;

  RELIEF_IN_LANES Floats at(float dy) const {
    return (splat.xx * dx + splat.xy * dy) * dx + splat.yy * dy * dy;
  }
};

/// Calls `use` for each run of kLanes pixels: with the place of the first in a tile's arrays, the
/// splat's weights, and where the pixels are from its centre.
template <class Use>
[[gnu::always_inline]] inline void for_each_run(const Splat& splat, const Box& tile,
                                                const Use& use) {
  const Part part = part_of(splat.box, tile);
  const float top = static_cast<float>(tile.top + part.top) + 0.5F - splat.y;
  RunExponent run{splat, static_cast<float>(tile.left + part.left) - splat.x + 0.5F + steps()};
  std::size_t corner = place_of(part.left, part.top);
  if (splat.is_steep) {
    const Floats nothing = all_of(kLeastExponent);
    for (int x = part.left; x < part.right; x += kLanes, run.dx += kLanes, corner += kLanes) {
      for (int y = part.top; y < part.bottom; ++y) {
        const float dy = top + static_cast<float>(y - part.top);
        const Floats weights = exp2_of(larger(run.at(dy), nothing));
        use(corner + place_of(0, y - part.top), where(weights >= splat.least, weights * splat.peak),
            run.dx, dy);
      }
    }
    return;
  }
  // Here, so that they stay in registers: for all that is known the sums might overlap the splat.
  const Floats least = all_of(splat.least * splat.peak);
  const Floats down = all_of(splat.down);
  Floats first = exp2_of(run.at(top)) * splat.peak;
  Floats to_next_row = exp2_of(splat.xy * run.dx + splat.yy * (2.0F * top + 1.0F));
  Floats to_next_run =
      exp2_of(splat.xx * kLanes * (2.0F * run.dx + kLanes) + splat.xy * kLanes * top);
  for (int x = part.left; x < part.right; x += kLanes, run.dx += kLanes, corner += kLanes) {
    Floats weights = first;
    Floats factor = to_next_row;
    std::size_t place = corner;
    float dy = top;
    for (int y = part.top; y < part.bottom; ++y, dy += 1.0F, place += kStride) {
      use(place, where(weights >= least, weights), run.dx, dy);
      weights *= factor;
      factor *= down;
    }
    first *= to_next_run;
    to_next_run *= splat.right;
    to_next_row *= splat.slanted;
  }
}

}  // namespace relief::volume::cpu
