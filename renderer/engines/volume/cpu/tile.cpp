#include "renderer/engines/volume/cpu/tile.h"

#include <algorithm>
#include <cmath>

#include "renderer/engines/volume/cpu/lanes.h"
#include "renderer/engines/volume/cpu/splat_runs.h"

namespace relief::volume::cpu {
namespace {

RELIEF_IN_LANES Floats opacity_of(const Floats& weight, bool is_exponential, float most) {
  constexpr float kLog2E = 1.44269504F;
  const Floats alpha =
      is_exponential ? 1.0F - exp2_of(larger(-kLog2E * weight, all_of(kLeastExponent))) : weight;
  return smaller(alpha, all_of(most));
}

bool is_exponential(const CompositeRule& rule) {
  return rule.weight == KernelWeight::Integral && rule.attenuation == Attenuation::Exponential;
}

/// Mean depths of a kernel where pixels are from its splat's centre.
RELIEF_IN_LANES Floats depths_of(const SplatSurface& surface, const Floats& dx, float dy) {
  return surface.depth + surface.right * dx + surface.down * dy;
}

/// The shares of a kernel that lie before some limits.
RELIEF_IN_LANES Floats shares_before(const Floats& limits, const Floats& depths,
                                     const SplatSurface& surface) {
  return normal_distribution((limits - depths) * surface.per_deviation);
}

/// Opacities of these shares of what has such opacities (weight_before() in share_before.h).
RELIEF_IN_LANES Floats opacity_before(const Floats& alpha, const Floats& share) {
  Floats left = alpha * share;
  for (int i = 0; i < kLanes; ++i) {
    if (share[i] > 0.0F && share[i] < 1.0F) left[i] = -std::expm1(share[i] * std::log1p(-alpha[i]));
  }
  return left;
}

/// add() with the extras that are asked for: colours alone cost nothing more.
template <bool kHasLimits, bool kHasSurfaces>
[[gnu::always_inline]] inline void add_with(const Splat& splat, const SplatSurface* surface,
                                            const Box& tile, const TileExtras& extras,
                                            TileLayer& layer) {
  const Floats red = all_of(splat.red);
  const Floats green = all_of(splat.green);
  const Floats blue = all_of(splat.blue);
  for_each_run(splat, tile,
               [&](std::size_t first, const Floats& all, const Floats& dx, float dy)
                   RELIEF_INLINED {
                     Floats weights = all;
                     if constexpr (kHasLimits) {
                       const Floats limits = load(&(*extras.limits)[first]);
                       weights *= shares_before(limits, depths_of(*surface, dx, dy), *surface);
                     }
                     add_to(&layer.weight[first], weights);
                     add_to(&layer.red[first], weights * red);
                     add_to(&layer.green[first], weights * green);
                     add_to(&layer.blue[first], weights * blue);
                     if constexpr (kHasSurfaces) {
                       add_to(&extras.layer->normal_x[first], weights * surface->normal.x);
                       add_to(&extras.layer->normal_y[first], weights * surface->normal.y);
                       add_to(&extras.layer->normal_z[first], weights * surface->normal.z);
                       add_to(&extras.layer->depth[first], weights * depths_of(*surface, dx, dy));
                     }
                   });
}

/// Where what is behind `before` is half covered by what leaves `after`.
RELIEF_IN_LANES Ints covers_half(const Floats& before, const Floats& after) {
  return (before > 0.5F) & (after <= 0.5F);
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

RELIEF_FOR_EACH_CPU void add(const Splat& splat, const SplatSurface* surface, const Box& tile,
                             const TileExtras& extras, TileLayer& layer) {
  if (!extras.is_any()) return add_with<false, false>(splat, surface, tile, extras, layer);
  if (extras.limits == nullptr) return add_with<false, true>(splat, surface, tile, extras, layer);
  if (extras.layer == nullptr) return add_with<true, false>(splat, surface, tile, extras, layer);
  add_with<true, true>(splat, surface, tile, extras, layer);
}

RELIEF_FOR_EACH_CPU bool put_behind(const Box& touched, const Box& tile, const CompositeRule& rule,
                                    const TileExtras& extras, TileLayer& layer,
                                    TilePixels& pixels) {
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
      const Floats after = before - seen;
      const Floats share = where(weight > 0.0F, seen / weight);
      add_to(&pixels.red[first], share * load(&layer.red[first]));
      add_to(&pixels.green[first], share * load(&layer.green[first]));
      add_to(&pixels.blue[first], share * load(&layer.blue[first]));
      store(after, &pixels.transmittance[first]);
      const Floats still_open = where(after >= ends_at, open);
      any_open += still_open;
      store(still_open, &pixels.is_open[first]);
      for (TileFloats* const sums : {&layer.weight, &layer.red, &layer.green, &layer.blue})
        store(Floats{}, &(*sums)[first]);
      if (extras.shown == nullptr) continue;
      TileSurfaces& sums = *extras.layer;
      TileSurfaces& shown = *extras.shown;
      add_to(&shown.normal_x[first], share * load(&sums.normal_x[first]));
      add_to(&shown.normal_y[first], share * load(&sums.normal_y[first]));
      add_to(&shown.normal_z[first], share * load(&sums.normal_z[first]));
      const Floats depth = load(&shown.depth[first]);
      store(covers_half(before, after) ? load(&sums.depth[first]) / weight : depth,
            &shown.depth[first]);
      for (TileFloats* const of : {&sums.normal_x, &sums.normal_y, &sums.normal_z, &sums.depth})
        store(Floats{}, &(*of)[first]);
    }
  }
  float sum = 0.0F;
  for (int i = 0; i < kLanes; ++i) sum += any_open[i];
  return sum > 0.0F;
}

RELIEF_FOR_EACH_CPU void put_behind(const Splat& splat, const SplatSurface* surface,
                                    const Box& tile, const CompositeRule& rule,
                                    const TileExtras& extras, TilePixels& pixels) {
  const bool exponential = is_exponential(rule);
  const bool is_peak = rule.weight == KernelWeight::Peak;
  const auto least = static_cast<float>(rule.min_alpha);
  const auto most = static_cast<float>(rule.max_alpha);
  const auto ends_at = static_cast<float>(rule.min_transmittance);
  for_each_run(splat, tile,
               [&](std::size_t first, const Floats& all, const Floats& dx, float dy)
                   RELIEF_INLINED {
                     Floats weights = all;
                     Floats share = all_of(1.0F);
                     if (extras.limits != nullptr) {
                       const Floats limits = load(&(*extras.limits)[first]);
                       share = shares_before(limits, depths_of(*surface, dx, dy), *surface);
                       if (!is_peak) weights *= share;
                     }
                     Floats alpha = where(weights >= least, opacity_of(weights, exponential, most));
                     if (extras.limits != nullptr && is_peak) alpha = opacity_before(alpha, share);
                     const Floats open = load(&pixels.is_open[first]);
                     const Floats before = load(&pixels.transmittance[first]);
                     Floats seen = before * open * alpha;
                     const Ints stays = before - seen >= ends_at;
                     // As [Kerbl 2023] does: what would end a pixel is left out.
                     if (is_peak) seen = where(stays, seen);
                     const Floats after = before - seen;
                     add_to(&pixels.red[first], seen * splat.red);
                     add_to(&pixels.green[first], seen * splat.green);
                     add_to(&pixels.blue[first], seen * splat.blue);
                     store(after, &pixels.transmittance[first]);
                     store(where(stays, open), &pixels.is_open[first]);
                     if (extras.shown == nullptr) return;
                     TileSurfaces& shown = *extras.shown;
                     add_to(&shown.normal_x[first], seen * surface->normal.x);
                     add_to(&shown.normal_y[first], seen * surface->normal.y);
                     add_to(&shown.normal_z[first], seen * surface->normal.z);
                     const Floats depth = load(&shown.depth[first]);
                     store(covers_half(before, after) ? depths_of(*surface, dx, dy) : depth,
                           &shown.depth[first]);
                   });
}

bool is_open(const TilePixels& pixels) {
  float sum = 0.0F;
  for (const float open : pixels.is_open) sum += open;
  return sum > 0.0F;
}

}  // namespace relief::volume::cpu
