// Makes a region's patch: heights on a regular grid by moving least squares.
#pragma once

#include "common/patch.h"
#include "preprocess/convert_options.h"
#include "preprocess/resample/attributes/normal_source.h"
#include "preprocess/resample/scan_surface.h"
#include "preprocess/resample/support/support.h"

namespace relief {

struct ResampleOptions {
  double spacing = 0.0;      ///< grid step, world units
  double height_step = 0.0;  ///< world units per height index; 0: by steps_per_spacing
  double steps_per_spacing = kUsualStepsPerSpacing;  ///< height indices in a spacing
  int overlap_cells = 1;                             ///< width of the overlap margin
  std::uint32_t colour_scale = 1;  ///< colour texels per grid cell along each side
  NormalSource normals = NormalSource::Fits;
  bool seams = false;  ///< without a margin but over other tiles, for make_seams()
};

/// Resamples one region ([Ochotta 2008], section 3.1): support, then heights, then normals and
/// colours. The patch is cropped to its samples; without supported samples it is empty (width 0).
[[nodiscard]] Patch resample_region(const ScanSurface& scan, const Region& region,
                                    const ResampleOptions& options);

/// Returns the grid spacing, in world units, at which the regions have about `target` samples in
/// all, without margins. `factors`: each region's spacing in units of that (patch_spacing.h).
[[nodiscard]] double choose_spacing(const SurfaceSamples& samples, const NeighbourGraph& graph,
                                    const std::vector<Region>& regions,
                                    const std::vector<double>& factors, double target,
                                    bool seams = false);

}  // namespace relief
