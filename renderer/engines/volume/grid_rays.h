// An image's rays in the coordinates of a regular grid's sheets.
#pragma once

#include <optional>

#include "common/volume/scalar_volume.h"
#include "renderer/engines/volume/drawing.h"
#include "shaders/volume/layout.h"

namespace relief::volume {

/// The nodes that have kernels, both ends included.
struct NodeBox {
  glm::uvec3 low{0};
  glm::uvec3 high{0};

  [[nodiscard]] glm::uvec3 size() const { return high - low + 1U; }
};

/// The box of a cloud that is not empty.
[[nodiscard]] NodeBox box_of(const KernelCloud& cloud);

/// How the image's rays meet the box's sheets, without the scales of texels. None if a ray is so
/// flat, or a kernel so near to the eye, that sheets are no way to draw it.
[[nodiscard]] std::optional<shared::VolumeGrid> grid_rays(const VolumeFrame& frame,
                                                          const RegularGrid& grid,
                                                          const NodeBox& box);

}  // namespace relief::volume
