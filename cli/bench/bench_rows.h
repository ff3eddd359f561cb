// The rows of `relief bench`: every way to draw a scene on OpenGL.
#pragma once

#include <cstddef>
#include <vector>

#include "renderer/render.h"

namespace relief::cli {

/// Engines x primitives x interpolations, and `multipass` with radius factors 1 and 2, all with the
/// camera, size and material of `base`, colour alone, without a background (which costs all rows
/// the same). Cells are the surface, so that the interpolation is one of their border splats alone:
/// they have one row for each policy of levels (the finest, the one there is unasked, twice as
/// coarse, and one that a scene asks for).
[[nodiscard]] std::vector<RenderSettings> bench_rows(const RenderSettings& base);

/// What `relief render` does unasked, and what it is compared with: the fastest `multipass` with
/// the radius factor that it has unasked.
[[nodiscard]] std::vector<RenderSettings> compared_rows(const RenderSettings& base);

/// `multipass` with these radius factors.
[[nodiscard]] std::vector<RenderSettings> radius_factor_rows(const RenderSettings& base,
                                                             const std::vector<double>& factors);

/// Cells of `onepass` with these pixels a sample.
[[nodiscard]] std::vector<RenderSettings> level_rows(const RenderSettings& base,
                                                     const std::vector<double>& pixels);

/// Whether a row is what `relief render` does unasked.
[[nodiscard]] bool is_default(const RenderSettings& row);

/// The first row that is; there is one.
[[nodiscard]] std::size_t find_default(const std::vector<RenderSettings>& rows);

}  // namespace relief::cli
