// In which order footprints occlude one another.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/volume/kernels/kernel_cloud.h"
#include "renderer/volume/settings.h"
#include "renderer/volume/splats/footprint.h"
#include "renderer/volume/splats/kernel_order.h"

namespace relief {

/// A kernel that reaches into the image.
struct PlacedSplat {
  Footprint footprint;
  std::uint32_t kernel = 0;
};

/// A splat of the image's list, in a group: those of one group add up, and occlude the next ones
/// as one layer.
struct OrderedSplat {
  std::uint32_t splat = 0;  ///< of the placed ones
  std::uint32_t group = 0;  ///< ascending, front to back
};

/// All splats, front to back. With slabs a splat is in each that it reaches.
struct SplatOrder {
  std::vector<OrderedSplat> splats;
  bool has_slabs = false;
  /// Group g holds what lies at depths from first_depth + g * thickness on, for one thickness.
  double first_depth = 0.0;
  double thickness = 0.0;
};

/// The visibility that `Automatic` stands for. A cloud without a grid has no sheets: it is sorted.
[[nodiscard]] VolumeVisibility visibility_of(const KernelCloud& cloud, VolumeVisibility wanted);

/// Sorts by `visibility`, which is not Automatic. Equals keep the cloud's order. Slabs are
/// `thickness` thick (world units; 0: as the splats' depths suggest), or thicker where a splat
/// would be in more than 64 in the mean, which bounds the memory.
[[nodiscard]] SplatOrder order_splats(const KernelCloud& cloud, std::span<const PlacedSplat> splats,
                                      VolumeVisibility visibility, const RayCamera& camera,
                                      double thickness);

/// Slabs that hold all but 3e-4 of a kernel's depths: 3.5 standard deviations on either side.
inline constexpr double kSlabReach = 3.5;

}  // namespace relief
