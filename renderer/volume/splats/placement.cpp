#include "renderer/volume/splats/placement.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace relief {
namespace {

/// Kernels that are projected as one piece of work.
constexpr std::size_t kChunk = 16384;

}  // namespace

std::vector<PlacedSplat> place_splats(const KernelCloud& cloud, const View& view,
                                      std::span<const FootprintRule> rules,
                                      const Progress& progress) {
  const RayCamera camera = ray_camera(view);
  const glm::dvec2 size(view.width, view.height);
  std::vector<std::vector<PlacedSplat>> chunks((cloud.count() + kChunk - 1) / kChunk);
  tbb::parallel_for(std::size_t{0}, chunks.size(), [&](std::size_t c) {
    if (progress.cancelled()) return;
    for (std::size_t k = c * kChunk; k < std::min((c + 1) * kChunk, cloud.count()); ++k) {
      const auto footprint = footprint_of(cloud, k, camera, rules[cloud.part_of(k)]);
      if (!footprint) continue;
      const glm::dvec2 low = footprint->centre - footprint->reach;
      const glm::dvec2 high = footprint->centre + footprint->reach;
      if (!(high.x > 0.0 && high.y > 0.0 && low.x < size.x && low.y < size.y)) continue;
      chunks[c].push_back({*footprint, static_cast<std::uint32_t>(k)});
    }
  });
  std::vector<PlacedSplat> all;
  std::size_t count = 0;
  for (const auto& chunk : chunks) count += chunk.size();
  all.reserve(count);
  for (const auto& chunk : chunks) all.insert(all.end(), chunk.begin(), chunk.end());
  return all;
}

}  // namespace relief
