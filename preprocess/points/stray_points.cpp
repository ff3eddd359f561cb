#include "preprocess/points/stray_points.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <numeric>
#include <utility>

#include "common/median.h"
#include "preprocess/points/keep_points.h"
#include "preprocess/points/plane_fit.h"

namespace relief {
namespace {

// The tip of a cone or the corner of a cube is a spacing off the plane of its neighbours.
constexpr double kOffInSpacings = 2.0;
constexpr double kOffInDeviations = 4.0;
// At the border of a surface a point is 1.4 times as far from its neighbours as they are. Where the
// density of a scan jumps it may be several times as far, but is on their plane.
constexpr double kLoneInSpacings = 2.0;
constexpr double kLoneOffInSpacings = 0.5;
// Neighbours on a crease of 90 degrees are off their plane by 0.19 of the eighth's distance (rms),
// those in a ball by 0.45. Where a scan becomes sparse, features are as small as its spacing, too.
constexpr double kBallShare = 0.28;
constexpr float kSparseInMedians = 4.0F;
constexpr std::uint32_t kEighth = 8;
// Two rounds find all but some of 3,000 outliers among 36,000 points; a third finds few more.
constexpr int kStrayRounds = 3;

}  // namespace

std::vector<std::uint8_t> find_stray_points(const std::vector<glm::dvec3>& positions,
                                            const NeighbourGraph& graph) {
  std::vector<std::uint8_t> stray(positions.size(), 0);
  if (graph.k < kEighth) return stray;
  const std::vector<float> to_eighth = distances_to_eighth(positions, graph);
  const float sparse = kSparseInMedians * median_of(to_eighth);
  tbb::parallel_for(std::size_t{0}, positions.size(), [&](std::size_t i) {
    const auto neighbours = graph.of(i);
    const PlaneFit plane = fit_plane(positions, neighbours.front(), neighbours.subspan(1));
    std::vector<float> spacings;
    for (const std::uint32_t j : neighbours) spacings.push_back(graph.spacing[j]);
    const double spacing = median_of(std::move(spacings));
    const double own_spacing = std::sqrt(std::numbers::pi / kEighth) * to_eighth[i];
    const double off = std::abs(glm::dot(positions[i] - plane.middle, plane.normal));
    const bool is_off = off > kOffInSpacings * spacing && off > kOffInDeviations * plane.rms;
    const bool is_lone =
        own_spacing > kLoneInSpacings * spacing && off > kLoneOffInSpacings * spacing;
    const bool is_in_ball = to_eighth[i] > sparse && plane.rms > kBallShare * to_eighth[i];
    stray[i] = is_off || is_lone || is_in_ball ? 1 : 0;
  });
  return stray;
}

std::vector<std::uint8_t> drop_stray_points(Points& points, NeighbourGraph& graph,
                                            const Progress& progress) {
  std::vector<std::uint8_t> dropped(points.size(), 0);
  std::vector<std::uint32_t> left(points.size());
  std::iota(left.begin(), left.end(), 0U);
  for (int round = 0; round < kStrayRounds && !progress.cancelled(); ++round) {
    const std::vector<std::uint8_t> stray = find_stray_points(points.positions, graph);
    const auto count = static_cast<std::size_t>(std::ranges::count(stray, 1));
    if (count == 0 || 2 * count > points.size() || points.size() - count < kMinSurfacePoints) break;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < stray.size(); ++i) {
      if (stray[i] != 0)
        dropped[left[i]] = 1;
      else
        left[kept++] = left[i];
    }
    drop_points(points, stray);
    graph = neighbours_after_drop(graph, stray, points.positions);
  }
  return dropped;
}

}  // namespace relief
