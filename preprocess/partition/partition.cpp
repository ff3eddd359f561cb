#include "preprocess/partition/partition.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "preprocess/partition/move_borders.h"

namespace relief {
namespace {

// Pieces are split to a small share of the patches' cone: merging is fast and gives better shapes
// than cutting. Regions of the Dragon, Buddha and Lucy with 0.4: 292, 417, 226; 0.25: 274, 413,
// 207; 0.2: 274, 397, 197; 0.15: 278, 399, 204, in a tenth more time.
constexpr double kSplitShare = 0.2;

// Weights of borders, and the number of rounds of moving and merging: chosen on ten scans
// (docs/decisions/0030 has the table).
constexpr BorderWeights kBorderWeights{0.3, 4.0};
constexpr int kBorderRounds = 2;

// Wider limits for remaining small regions. At 78 degrees a patch is still single-valued; its
// samples are sparse there, but these are spots of a few dozen points.
constexpr double kWideConeDegrees = 78.0;
constexpr double kWideSheetTolerance = 2.0;

std::size_t small_points(std::size_t points) {
  return std::clamp<std::size_t>(points / 1000, 16, 64);
}

}  // namespace

Membership membership_of(const SurfaceSamples& samples, const std::vector<Region>& regions) {
  const std::size_t points = samples.normals.size();
  Membership membership{{}, std::vector<float>(points, 1.0F)};
  membership.region.assign(points, static_cast<std::uint32_t>(regions.size()));
  for (std::uint32_t r = 0; r < regions.size(); ++r) {
    for (const std::uint32_t i : regions[r].points) {
      membership.region[i] = r;
      membership.cosine[i] = glm::dot(samples.normals[i], regions[r].normal);
    }
  }
  return membership;
}

std::vector<Region> partition(const SurfaceSamples& samples, const NeighbourGraph& graph,
                              std::vector<std::uint32_t> points, double cone_degrees,
                              const std::vector<std::uint8_t>* at_crease, Progress& progress) {
  const std::size_t small = small_points(points.size());
  progress.begin_stage("split", points.size());
  std::vector<Region> regions = split(samples, graph, std::move(points),
                                      {.cone_degrees = kSplitShare * cone_degrees}, progress);
  const MergeRule rule{.limits = {.cone_degrees = cone_degrees}, .at_crease = at_crease};
  regions = merge(samples, graph, std::move(regions), rule, progress);
  for (int round = 0; round < kBorderRounds && !progress.cancelled(); ++round) {
    move_borders(samples, graph, cone_degrees, kBorderWeights, regions);
    // Once is enough: regions that fall apart in the first round join again in its merge.
    if (round + 1 == kBorderRounds) regions = part_components(samples, graph, regions);
    regions = merge(samples, graph, std::move(regions), rule, progress);
  }
  const RegionLimits wide{.cone_degrees = std::max(cone_degrees, kWideConeDegrees),
                          .sheet_tolerance = kWideSheetTolerance};
  const MergeRule wide_rule{wide, small, at_crease};
  regions = merge(samples, graph, std::move(regions), wide_rule, progress);
  std::sort(regions.begin(), regions.end(), [](const Region& a, const Region& b) {
    if (a.points.size() != b.points.size()) return a.points.size() > b.points.size();
    return a.points.front() < b.points.front();
  });
  return regions;
}

}  // namespace relief
