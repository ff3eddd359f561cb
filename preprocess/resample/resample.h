// From a region to its patch: heights on a regular grid by moving least squares.
#pragma once

#include "common/patch.h"
#include "preprocess/resample/support.h"

namespace relief {

struct ResampleOptions {
  double spacing = 0.0;              ///< grid step, world units
  double height_step = 0.0;          ///< world units per height index; 0: spacing / 20
  int overlap_cells = 1;             ///< width of the overlap margin
  std::uint32_t colour_scale = 1;    ///< colour texels per grid cell along each side
  bool normals_from_points = false;  ///< the points' own normals instead of the fitted surface's
};

/// Resamples one region (paper 001, section 3.1): support, then heights, then normals and colours.
/// `membership` of all points; `colours` is empty or one per point of the scan. The patch
/// is cropped to its samples; it has none (width 0) if nothing supports any.
[[nodiscard]] Patch resample_region(const SurfaceSamples& samples, const NeighbourGraph& graph,
                                    const Region& region, const Membership& membership,
                                    const std::vector<glm::u8vec3>& colours,
                                    const ResampleOptions& options);

/// The grid spacing at which the regions have about `target` samples of their own (margins apart),
/// world units. `factors`: each region's own spacing in such (spacing_factors).
[[nodiscard]] double choose_spacing(const SurfaceSamples& samples, const NeighbourGraph& graph,
                                    const std::vector<Region>& regions,
                                    const std::vector<double>& factors, std::size_t target);

}  // namespace relief
