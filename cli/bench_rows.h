// The rows of `relief bench`: every way to draw a scene on OpenGL.
#pragma once

#include <cstddef>
#include <vector>

#include "renderer/render.h"

namespace relief::cli {

/// Engines x primitives x interpolations, and `multipass` with radius factors 1 and 2, all with the
/// camera, size and material of `base`, colour alone, without a background (which costs all rows
/// the same). Cells are the surface, so that the interpolation is one of their border splats alone:
/// they have one row.
[[nodiscard]] std::vector<RenderSettings> bench_rows(const RenderSettings& base);

/// Whether a row is what `relief render` does unasked.
[[nodiscard]] bool is_default(const RenderSettings& row);

/// The row that is; there is exactly one.
[[nodiscard]] std::size_t find_default(const std::vector<RenderSettings>& rows);

}  // namespace relief::cli
