#include <tbb/parallel_for.h>

#include <algorithm>
#include <iterator>

#include "preprocess/partition/partition.h"

namespace relief {
namespace {

// The components of one region. `done` is written only at the region's own points.
std::vector<Region> pieces_of(const SurfaceSamples& samples, const NeighbourGraph& graph,
                              const Region& region, const std::vector<std::uint32_t>& region_of,
                              std::vector<std::uint8_t>& done) {
  std::vector<Region> pieces;
  std::vector<std::uint32_t> reached;  // from the seed
  std::vector<std::uint32_t> waiting;  // those whose neighbours are not yet visited
  for (const std::uint32_t seed : region.points) {
    if (done[seed] != 0) continue;
    done[seed] = 1;
    reached.assign(1, seed);
    waiting.assign(1, seed);
    while (!waiting.empty()) {
      const std::uint32_t i = waiting.back();
      waiting.pop_back();
      for (const std::uint32_t j : graph.of(i)) {
        if (region_of[j] != region_of[seed] || done[j] != 0) continue;
        if (!on_one_sheet(samples, i, j)) continue;
        done[j] = 1;
        reached.push_back(j);
        waiting.push_back(j);
      }
      // Most regions are connected, and small ones are confirmed after a point or two.
      if (reached.size() == region.points.size()) return {region};
    }
    std::sort(reached.begin(), reached.end());
    pieces.push_back({reached, region.normal});
  }
  return pieces;
}

}  // namespace

std::vector<Region> part_components(const SurfaceSamples& samples, const NeighbourGraph& graph,
                                    const std::vector<Region>& regions) {
  std::vector<std::uint32_t> region_of(samples.positions.size(), 0xFFFFFFFFU);
  for (std::uint32_t r = 0; r < regions.size(); ++r) {
    for (const std::uint32_t i : regions[r].points) region_of[i] = r;
  }
  std::vector<std::uint8_t> done(samples.positions.size(), 0);
  std::vector<std::vector<Region>> parts(regions.size());
  tbb::parallel_for(std::size_t{0}, regions.size(), [&](std::size_t r) {
    parts[r] = pieces_of(samples, graph, regions[r], region_of, done);
  });
  std::vector<Region> pieces;
  for (std::vector<Region>& part : parts) std::ranges::move(part, std::back_inserter(pieces));
  return pieces;
}

}  // namespace relief
