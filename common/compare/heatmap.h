// Error maps as images.
#pragma once

#include <cstdint>
#include <vector>

#include "common/image/image.h"

namespace relief {

/// Returns a map of values in [0, 1] in the magma colours that FLIP is published in: from black (0)
/// over violet, red and orange to pale yellow (1). write_png keeps each of the 256 colours as its
/// 8-bit value.
[[nodiscard]] Image make_heatmap(const std::vector<float>& map, std::uint32_t width,
                                 std::uint32_t height);

}  // namespace relief
