#include "preprocess/partition/find_regions.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "common/median.h"
#include "preprocess/resample/spacing/patch_spacing.h"

namespace relief {
namespace {

// 70 degrees stretch samples by at most 1 / cos 70 = 2.9. 75 make a tenth fewer patches, and more
// spikes at silhouettes (docs/decisions/0030).
constexpr double kDefaultConeDegrees = 70.0;
// Regions of fewer points are not a surface.
constexpr std::size_t kMinPatchPoints = 4;
// Nor are bare points this few where they are far sparser than the scan: some of a cloud of
// outliers that lie on a plane by chance.
constexpr std::size_t kFewSparsePoints = 16;
// A cloud of outliers: the eighth neighbour is this much farther than the scan's median one, and
// the plane through the neighbourhood is left by more than this share of that distance (a ball of
// points has 0.2 to 0.3, a surface that bends by 60 degrees across its neighbourhood 0.08).
constexpr float kSparseInMedians = 4.0F;
constexpr float kRoughShare = 0.08F;

// The points that can be part of a surface: all but clouds of outliers, which are much sparser than
// the scan and not flat either. (Single outliers are not connected and form no region.)
std::vector<std::uint32_t> surface_points(const std::vector<glm::dvec3>& positions,
                                          std::size_t count, const NeighbourGraph& graph,
                                          const LocalFrames& frames) {
  if (positions.empty()) return {};
  const std::vector<float> to_eighth = distances_to_eighth(positions, graph);
  const float usual = median_of(to_eighth);
  std::vector<std::uint32_t> points;
  for (std::uint32_t i = 0; i < count; ++i) {
    const bool scattered =
        to_eighth[i] > kSparseInMedians * usual && frames.roughness[i] > kRoughShare * to_eighth[i];
    if (!scattered) points.push_back(i);
  }
  return points;
}

/// Returns whether a region's points are far sparser than the scan, whose median spacing is
/// `usual`.
bool is_sparse(const NeighbourGraph& graph, const Region& region, float usual) {
  float sum = 0.0F;
  for (const std::uint32_t i : region.points) sum += graph.spacing[i];
  return sum > kSparseInMedians * usual * static_cast<float>(region.points.size());
}

// Returns whether a region continues in the surrounding points, which are those from `count` on.
bool goes_on_around(const SurfaceSamples& samples, const NeighbourGraph& graph,
                    const Region& region, std::size_t count) {
  return std::ranges::any_of(region.points, [&](std::uint32_t i) {
    return std::ranges::any_of(
        graph.of(i), [&](std::uint32_t j) { return j >= count && on_one_sheet(samples, i, j); });
  });
}

}  // namespace

std::vector<Region> find_regions(const Points& points, std::size_t count,
                                 const NeighbourGraph& graph, const LocalFrames& frames,
                                 double cone_degrees, const CreaseNormals* creases,
                                 Progress& progress) {
  std::vector<glm::vec3> smooth = smooth_normals(points.normals, graph);
  for (std::size_t i = 0; creases != nullptr && i < smooth.size(); ++i) {
    if (creases->at_crease[i] != 0) smooth[i] = creases->normals[i];
  }
  const SurfaceSamples samples{points.positions, smooth, graph.spacing, frames.roughness};
  const double cone = cone_degrees > 0.0 ? cone_degrees : kDefaultConeDegrees;
  std::vector<Region> regions =
      partition(samples, graph, surface_points(points.positions, count, graph, frames), cone,
                creases != nullptr ? &creases->at_crease : nullptr, progress);
  const bool is_bare = points.triangles.empty();
  const float usual = is_bare && !graph.spacing.empty() ? median_of(graph.spacing) : 0.0F;
  std::erase_if(regions, [&](const Region& r) {
    const bool is_stray =
        is_bare && r.points.size() < kFewSparsePoints && is_sparse(graph, r, usual);
    return (r.points.size() < kMinPatchPoints || is_stray) &&
           !goes_on_around(samples, graph, r, count);
  });
  return regions;
}

}  // namespace relief
