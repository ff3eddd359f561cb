// Splats of neighbouring groups, ready to be composited.
#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "common/progress.h"
#include "renderer/volume/splats/footprint.h"
#include "renderer/volume/splats/kernel_order.h"
#include "renderer/volume/splats/splat_order.h"
#include "renderer/volume/volume_model.h"

namespace relief::volume_reference {

struct Batch {
  std::vector<PlacedSplat> splats;
  std::vector<glm::vec3> colours;  ///< of each splat, as it is blended
  SplatOrder order;
};

/// How kernels become splats in an image.
struct Placement {
  const KernelCloud& cloud;
  const View& view;
  std::span<const FootprintRule> rules;  ///< of each part of the cloud
  const KernelColour& colour;
};

/// The splats of the order's groups from `first` to before `end`, but for those that are hidden:
/// they are neither kept nor shaded. `is_hidden` is called from many threads.
[[nodiscard]] Batch place_groups(const Placement& placement, const KernelOrder& order,
                                 std::size_t first, std::size_t end,
                                 const std::function<bool(const Footprint&)>& is_hidden,
                                 const Progress& progress);

/// All splats, in slabs of that thickness (world units).
[[nodiscard]] Batch place_slabs(const Placement& placement, double thickness,
                                const Progress& progress);

}  // namespace relief::volume_reference
