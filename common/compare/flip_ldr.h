// LDR-FLIP of two pictures, at one exposure.
#pragma once

#include <optional>
#include <vector>

#include "common/compare/colour_errors.h"
#include "common/compare/flip_filters.h"
#include "common/progress.h"

namespace relief {

/// Raises each value of `map` to the LDR-FLIP (2020, section 4) of the pictures there, where that
/// is larger. With `exposure` the colours are multiplied by 2^exposure and tone-mapped first,
/// without they are clamped to [0, 1]. Beyond the rim a picture goes on as its outermost pixels.
/// Works in bands of rows on all threads; the result does not depend on their number. Tells
/// `progress` the rows that are done, and leaves bands out once it is cancelled.
void raise_to_ldr_flip(const LinearColour& test, const LinearColour& reference,
                       std::optional<double> exposure, const FlipFilters& filters,
                       std::vector<float>& map, Progress& progress);

}  // namespace relief
