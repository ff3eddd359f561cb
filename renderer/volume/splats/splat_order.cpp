#include "renderer/volume/splats/splat_order.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

namespace relief {
namespace {

/// More slabs than this, or more for each splat than that in the mean, are made thicker: a hostile
/// kernel may be as deep as it likes.
constexpr double kMostSlabs = 65536.0;
constexpr double kMostSlabsOfSplat = 64.0;
/// Half the depth, world units, of a splat that has none that can be reckoned with.
constexpr double kDeepest = 1e150;

/// Stable, by group.
void sort_by_group(std::vector<OrderedSplat>& splats, std::size_t groups) {
  std::vector<std::size_t> starts(groups + 1, 0);
  for (const OrderedSplat& splat : splats) ++starts[splat.group + 1];
  std::partial_sum(starts.begin(), starts.end(), starts.begin());
  std::vector<OrderedSplat> sorted(splats.size());
  for (const OrderedSplat& splat : splats) sorted[starts[splat.group]++] = splat;
  splats = std::move(sorted);
}

/// The splats in the order of their kernels.
SplatOrder in_order(const KernelOrder& kernels, std::span<const PlacedSplat> splats) {
  constexpr std::uint32_t kNotPlaced = UINT32_MAX;
  std::vector<std::uint32_t> splat_of(kernels.kernels.size(), kNotPlaced);
  for (std::uint32_t s = 0; s < splats.size(); ++s) splat_of[splats[s].kernel] = s;
  SplatOrder order;
  order.splats.reserve(splats.size());
  for (std::uint32_t g = 0; g < kernels.groups(); ++g) {
    for (const std::uint32_t kernel : kernels.group(g)) {
      if (splat_of[kernel] != kNotPlaced) order.splats.push_back({splat_of[kernel], g});
    }
  }
  return order;
}

/// The depths that a splat reaches anywhere in its footprint.
std::array<double, 2> depths_of(const Footprint& footprint) {
  const double over_image = std::abs(footprint.slope.x) * footprint.reach.x +
                            std::abs(footprint.slope.y) * footprint.reach.y;
  const double reach = kSlabReach * footprint.depth_deviation + over_image;
  const double half = reach < kDeepest ? reach : kDeepest;
  return {footprint.depth - half, footprint.depth + half};
}

SplatOrder by_slabs(std::span<const PlacedSplat> splats, double thickness) {
  SplatOrder order;
  order.has_slabs = true;
  if (splats.empty()) return order;
  double first = splats.front().footprint.depth;
  double last = first;
  double mean = 0.0;
  for (const PlacedSplat& splat : splats) {
    const auto [low, high] = depths_of(splat.footprint);
    first = std::min(first, low);
    last = std::max(last, high);
    mean += (high - low) / static_cast<double>(splats.size());
  }
  order.first_depth = first;
  // Without a thickness a splat is in as many slabs as one of a grid with a spacing of 1.
  order.thickness = thickness > 0.0 ? thickness : mean / (2.0 * kSlabReach);
  order.thickness =
      std::max({order.thickness, mean / kMostSlabsOfSplat, (last - first) / kMostSlabs});
  if (!(order.thickness > 0.0)) order.thickness = 1.0;  // all are at one depth
  const auto slab_of = [&](double depth) {
    return static_cast<std::uint32_t>(
        std::clamp((depth - first) / order.thickness, 0.0, kMostSlabs));
  };
  for (std::uint32_t s = 0; s < splats.size(); ++s) {
    const auto [low, high] = depths_of(splats[s].footprint);
    for (std::uint32_t slab = slab_of(low); slab <= slab_of(high); ++slab)
      order.splats.push_back({s, slab});
  }
  sort_by_group(order.splats, slab_of(last) + std::size_t{1});
  return order;
}

}  // namespace

VolumeVisibility visibility_of(const KernelCloud& cloud, VolumeVisibility wanted) {
  if (wanted == VolumeVisibility::Automatic || wanted == VolumeVisibility::Sheet)
    return cloud.nodes.empty() ? VolumeVisibility::Sorted : VolumeVisibility::Sheet;
  return wanted;
}

SplatOrder order_splats(const KernelCloud& cloud, std::span<const PlacedSplat> splats,
                        VolumeVisibility visibility, const RayCamera& camera, double thickness) {
  switch (visibility) {
    case VolumeVisibility::Sheet:
      return in_order(order_by_sheets(cloud, camera), splats);
    case VolumeVisibility::ImageSheet:
      return by_slabs(splats, thickness);
    case VolumeVisibility::Automatic:
    case VolumeVisibility::Sorted:
      break;
  }
  return in_order(order_by_depth(cloud, camera), splats);
}

}  // namespace relief
