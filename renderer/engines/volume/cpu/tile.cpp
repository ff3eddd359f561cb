#include "renderer/engines/volume/cpu/tile.h"

#include <algorithm>

#include "renderer/engines/volume/cpu/lanes.h"

namespace relief::volume::cpu {
namespace {

static_assert(kSide + kLanes <= kStride);

/// The part of a box in a tile, from the tile's corner; ends excluded.
struct Part {
  int top = 0;
  int bottom = 0;
  int left = 0;
  int right = 0;
};

Part part_of(const Box& box, const Box& tile) {
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

/// Calls `use` with a splat's weights in each run of kLanes pixels and the place of the first in a
/// tile's arrays.
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
        const Floats e = run.at(top + static_cast<float>(y - part.top));
        const Floats weights = exp2_of(larger(e, nothing));
        use(corner + place_of(0, y - part.top),
            where(weights >= splat.least, weights * splat.peak));
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
  for (int x = part.left; x < part.right; x += kLanes, corner += kLanes) {
    Floats weights = first;
    Floats factor = to_next_row;
    std::size_t place = corner;
    for (int y = part.top; y < part.bottom; ++y, place += kStride) {
      use(place, where(weights >= least, weights));
      weights *= factor;
      factor *= down;
    }
    first *= to_next_run;
    to_next_run *= splat.right;
    to_next_row *= splat.slanted;
  }
}

RELIEF_IN_LANES Floats opacity_of(const Floats& weight, bool is_exponential, float most) {
  constexpr float kLog2E = 1.44269504F;
  const Floats alpha =
      is_exponential ? 1.0F - exp2_of(larger(-kLog2E * weight, all_of(kLeastExponent))) : weight;
  return smaller(alpha, all_of(most));
}

bool is_exponential(const CompositeRule& rule) {
  return rule.weight == KernelWeight::Integral && rule.attenuation == Attenuation::Exponential;
}

}  // namespace

TilePixels open_tile(const Box& tile) {
  TilePixels pixels;
  pixels.transmittance.fill(1.0F);
  for (int y = 0; y <= tile.bottom - tile.top; ++y) {
    float* const row = &pixels.is_open[place_of(0, y)];
    std::fill(row, row + (tile.right - tile.left + 1), 1.0F);
  }
  return pixels;
}

RELIEF_FOR_EACH_CPU void add(const Splat& splat, const Box& tile, TileLayer& layer) {
  const Floats red = all_of(splat.red);
  const Floats green = all_of(splat.green);
  const Floats blue = all_of(splat.blue);
  for_each_run(splat, tile, [&](std::size_t first, const Floats& weights) RELIEF_INLINED {
    add_to(&layer.weight[first], weights);
    add_to(&layer.red[first], weights * red);
    add_to(&layer.green[first], weights * green);
    add_to(&layer.blue[first], weights * blue);
  });
}

RELIEF_FOR_EACH_CPU bool put_behind(const Box& touched, const Box& tile, const CompositeRule& rule,
                                    TileLayer& layer, TilePixels& pixels) {
  const Part part = part_of(touched, tile);
  const bool exponential = is_exponential(rule);
  const auto most = static_cast<float>(rule.max_alpha);
  const auto ends_at = static_cast<float>(rule.min_transmittance);
  Floats any_open{};
  for (int y = part.top; y < part.bottom; ++y) {
    for (int x = part.left; x < part.right; x += kLanes) {
      const std::size_t first = place_of(x, y);
      const Floats weight = load(&layer.weight[first]);
      const Floats open = load(&pixels.is_open[first]);
      const Floats before = load(&pixels.transmittance[first]);
      const Floats seen = before * open * opacity_of(weight, exponential, most);
      const Floats share = where(weight > 0.0F, seen / weight);
      add_to(&pixels.red[first], share * load(&layer.red[first]));
      add_to(&pixels.green[first], share * load(&layer.green[first]));
      add_to(&pixels.blue[first], share * load(&layer.blue[first]));
      store(before - seen, &pixels.transmittance[first]);
      const Floats still_open = where(before - seen >= ends_at, open);
      any_open += still_open;
      store(still_open, &pixels.is_open[first]);
      for (TileFloats* const sums : {&layer.weight, &layer.red, &layer.green, &layer.blue})
        store(Floats{}, &(*sums)[first]);
    }
  }
  float sum = 0.0F;
  for (int i = 0; i < kLanes; ++i) sum += any_open[i];
  return sum > 0.0F;
}

RELIEF_FOR_EACH_CPU void put_behind(const Splat& splat, const Box& tile, const CompositeRule& rule,
                                    TilePixels& pixels) {
  const bool exponential = is_exponential(rule);
  const bool is_peak = rule.weight == KernelWeight::Peak;
  const auto least = static_cast<float>(rule.min_alpha);
  const auto most = static_cast<float>(rule.max_alpha);
  const auto ends_at = static_cast<float>(rule.min_transmittance);
  for_each_run(splat, tile, [&](std::size_t first, const Floats& weights) RELIEF_INLINED {
    const Floats alpha = where(weights >= least, opacity_of(weights, exponential, most));
    const Floats open = load(&pixels.is_open[first]);
    const Floats before = load(&pixels.transmittance[first]);
    Floats seen = before * open * alpha;
    const Ints stays = before - seen >= ends_at;
    // As [Kerbl 2023] does: what would end a pixel is left out.
    if (is_peak) seen = where(stays, seen);
    add_to(&pixels.red[first], seen * splat.red);
    add_to(&pixels.green[first], seen * splat.green);
    add_to(&pixels.blue[first], seen * splat.blue);
    store(before - seen, &pixels.transmittance[first]);
    store(where(stays, open), &pixels.is_open[first]);
  });
}

bool is_open(const TilePixels& pixels) {
  float sum = 0.0F;
  for (const float open : pixels.is_open) sum += open;
  return sum > 0.0F;
}

}  // namespace relief::volume::cpu
