#include "renderer/volume/splat_order.h"

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

SplatOrder by_depth(std::span<const PlacedSplat> splats) {
  SplatOrder order;
  order.splats.resize(splats.size());
  std::vector<std::uint32_t> indices(splats.size());
  std::iota(indices.begin(), indices.end(), 0U);
  std::stable_sort(indices.begin(), indices.end(), [&](std::uint32_t a, std::uint32_t b) {
    return splats[a].footprint.depth < splats[b].footprint.depth;
  });
  for (std::uint32_t rank = 0; rank < indices.size(); ++rank)
    order.splats[rank] = {indices[rank], rank};
  return order;
}

/// Sheets by their distance from the eye along the axis: a ray meets those of one side only, in
/// this order.
std::vector<std::uint32_t> rank_sheets(const KernelCloud& cloud,
                                       std::span<const PlacedSplat> splats, glm::length_t axis,
                                       const RayCamera& camera) {
  const std::size_t sheets = cloud.size[axis];
  std::vector<double> sums(sheets, 0.0);
  std::vector<double> counts(sheets, 0.0);
  for (const PlacedSplat& splat : splats) {
    const std::uint32_t sheet = cloud.node(splat.kernel)[axis];
    sums[sheet] += glm::dot(cloud.centres[splat.kernel] - camera.eye, cloud.across[axis]);
    counts[sheet] += 1.0;
  }
  const double forward = (camera.rotation * cloud.across[axis]).z;
  std::vector<double> distances(sheets, 0.0);
  for (std::size_t s = 0; s < sheets; ++s) {
    if (counts[s] == 0.0) continue;
    const double along = sums[s] / counts[s];
    distances[s] = camera.orthographic ? along * (forward < 0.0 ? -1.0 : 1.0) : std::abs(along);
  }
  std::vector<std::uint32_t> sorted(sheets);
  std::iota(sorted.begin(), sorted.end(), 0U);
  std::stable_sort(sorted.begin(), sorted.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return distances[a] < distances[b]; });
  std::vector<std::uint32_t> ranks(sheets);
  for (std::uint32_t rank = 0; rank < sheets; ++rank) ranks[sorted[rank]] = rank;
  return ranks;
}

SplatOrder by_sheets(const KernelCloud& cloud, std::span<const PlacedSplat> splats,
                     const RayCamera& camera) {
  const glm::length_t axis = sheet_axis(cloud, camera);
  const std::vector<std::uint32_t> ranks = rank_sheets(cloud, splats, axis, camera);
  SplatOrder order;
  order.splats.reserve(splats.size());
  for (std::uint32_t s = 0; s < splats.size(); ++s)
    order.splats.push_back({s, ranks[cloud.node(splats[s].kernel)[axis]]});
  sort_by_group(order.splats, ranks.size());
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

glm::length_t sheet_axis(const KernelCloud& cloud, const RayCamera& camera) {
  glm::length_t best = 0;
  double most = -1.0;
  for (glm::length_t axis = 0; axis < 3; ++axis) {
    const double along = std::abs((camera.rotation * cloud.across[axis]).z);
    if (along > most) {
      most = along;
      best = axis;
    }
  }
  return best;
}

VolumeVisibility visibility_of(const KernelCloud& cloud, VolumeVisibility wanted) {
  if (wanted == VolumeVisibility::Automatic || wanted == VolumeVisibility::Sheet)
    return cloud.nodes.empty() ? VolumeVisibility::Sorted : VolumeVisibility::Sheet;
  return wanted;
}

SplatOrder order_splats(const KernelCloud& cloud, std::span<const PlacedSplat> splats,
                        VolumeVisibility visibility, const RayCamera& camera, double thickness) {
  switch (visibility) {
    case VolumeVisibility::Sheet:
      return by_sheets(cloud, splats, camera);
    case VolumeVisibility::ImageSheet:
      return by_slabs(splats, thickness);
    case VolumeVisibility::Automatic:
    case VolumeVisibility::Sorted:
      break;
  }
  return by_depth(splats);
}

}  // namespace relief
