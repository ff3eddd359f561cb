// An image's rays in the coordinates of a regular grid's sheets.
#pragma once

#include <optional>

#include "common/volume/scalar_volume.h"
#include "renderer/engines/volume/drawing.h"
#include "shaders/volume/layout.h"

namespace relief::volume {

/// The box of a cloud of a grid; goes over all kernels.
[[nodiscard]] NodeBox box_of(const KernelCloud& cloud);

/// How the image's rays meet the sheets of the frame's box, without the scales of texels. None if a
/// ray is so flat, or a kernel so near to the eye, that sheets are no way to draw it.
[[nodiscard]] std::optional<shared::VolumeGrid> grid_rays(const VolumeFrame& frame,
                                                          const RegularGrid& grid);

}  // namespace relief::volume
