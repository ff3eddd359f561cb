#include "renderer/engines/volume_reference/batch.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <span>

#include "renderer/volume/splats/placement.h"

namespace relief::volume_reference {
namespace {

/// Kernels that are projected and shaded as one piece of work.
constexpr std::size_t kPiece = 2048;

/// The group of each kernel of some groups.
std::vector<std::uint32_t> groups_of(const KernelOrder& order, std::size_t first, std::size_t end) {
  std::vector<std::uint32_t> groups;
  groups.reserve(order.starts[end] - order.starts[first]);
  for (std::size_t g = first; g < end; ++g)
    groups.insert(groups.end(), order.group(g).size(), static_cast<std::uint32_t>(g));
  return groups;
}

}  // namespace

Batch place_groups(const Placement& placement, const KernelOrder& order, std::size_t first,
                   std::size_t end, const std::function<bool(const Footprint&)>& is_hidden,
                   const Progress& progress) {
  const std::span<const std::uint32_t> kernels =
      std::span(order.kernels)
          .subspan(order.starts[first], order.starts[end] - order.starts[first]);
  const std::vector<std::uint32_t> groups = groups_of(order, first, end);
  const RayCamera camera = ray_camera(placement.view);
  std::vector<Batch> pieces((kernels.size() + kPiece - 1) / kPiece);
  tbb::parallel_for(std::size_t{0}, pieces.size(), [&](std::size_t p) {
    if (progress.cancelled()) return;
    Batch& piece = pieces[p];
    for (std::size_t i = p * kPiece; i < std::min((p + 1) * kPiece, kernels.size()); ++i) {
      const auto footprint = footprint_of(placement.cloud, kernels[i], camera,
                                          placement.rules[placement.cloud.part_of(kernels[i])]);
      if (!footprint || is_hidden(*footprint)) continue;
      piece.splats.push_back({*footprint, kernels[i]});
      piece.colours.push_back(placement.colour(kernels[i]));
      piece.order.splats.push_back({0, groups[i]});
    }
  });
  Batch batch;
  for (const Batch& piece : pieces) {
    for (const OrderedSplat& ordered : piece.order.splats) {
      const auto splat = static_cast<std::uint32_t>(batch.order.splats.size());
      batch.order.splats.push_back({splat, ordered.group});
    }
    batch.splats.insert(batch.splats.end(), piece.splats.begin(), piece.splats.end());
    batch.colours.insert(batch.colours.end(), piece.colours.begin(), piece.colours.end());
  }
  return batch;
}

Batch place_slabs(const Placement& placement, double thickness, const Progress& progress) {
  Batch batch;
  batch.splats = place_splats(placement.cloud, placement.view, placement.rules, progress);
  batch.order = order_splats(placement.cloud, batch.splats, VolumeVisibility::ImageSheet,
                             ray_camera(placement.view), thickness);
  batch.colours.resize(batch.splats.size());
  tbb::parallel_for(std::size_t{0}, batch.splats.size(), [&](std::size_t s) {
    batch.colours[s] = placement.colour(batch.splats[s].kernel);
  });
  return batch;
}

}  // namespace relief::volume_reference
