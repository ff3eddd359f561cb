// LDR-FLIP of two images, at one exposure.
#pragma once

#include <optional>
#include <vector>

#include "common/compare/colour_errors.h"
#include "common/compare/flip_filters.h"
#include "common/compare/flip_tiles.h"
#include "common/progress.h"

namespace relief {

/// Raises each value of `map` within `tiles`, which are disjoint, to the images' LDR-FLIP (2020,
/// section 4) at that pixel, if that is larger. With `exposure`, colours are multiplied by
/// 2^exposure and tone-mapped first; without, they are clamped to [0, 1]. Beyond the rim an image
/// repeats its outermost pixels. Works on all threads; a pixel's value depends neither on their
/// number nor on the tile about it. Reports finished tiles to `progress`, and skips the remaining
/// ones once it is cancelled.
void raise_to_ldr_flip(const LinearColour& test, const LinearColour& reference,
                       std::optional<double> exposure, const FlipFilters& filters,
                       const std::vector<FlipTile>& tiles, std::vector<float>& map,
                       Progress& progress);

}  // namespace relief
