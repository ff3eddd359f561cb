// Prefiltered sheets as an image's rays see them.
#pragma once

#include <optional>

#include "common/volume/scalar_volume.h"
#include "renderer/engines/volume/drawing.h"
#include "renderer/engines/volume/sheet_atlas.h"
#include "shaders/volume/layout.h"

namespace relief::volume {

/// Variance that reading a sheet between its nodes adds: the mean of that of a line between two.
inline constexpr double kReadVariance = 1.0 / 6.0;

/// How the sheets of a frame are shaded and widened, and where they lie. `rays`: those of the frame
/// (grid_rays). None if kernels are too narrow to be read between nodes or too wide for the
/// margins.
[[nodiscard]] std::optional<shared::VolumeSheets> sheet_view(const VolumeFrame& frame,
                                                             const RegularGrid& grid,
                                                             const shared::VolumeGrid& rays,
                                                             const SheetAtlas& atlas);

/// Which of x, y and z are u, v and w.
[[nodiscard]] glm::ivec3 axes_of(const shared::VolumeGrid& rays);

}  // namespace relief::volume
