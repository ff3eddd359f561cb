// Error maps as pictures.
#pragma once

#include <cstdint>
#include <vector>

#include "common/image/image.h"

namespace relief {

/// The picture of a map of values in [0, 1] in the colours of magma, as FLIP is published: 0 is
/// black, then violet, red, orange, 1 is a pale yellow. Each of the 256 colours comes out of
/// write_png as the same 8-bit values.
[[nodiscard]] Image make_heatmap(const std::vector<float>& map, std::uint32_t width,
                                 std::uint32_t height);

}  // namespace relief
