#include "preprocess/points/outliers.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "common/median.h"
#include "common/neighbours/neighbours.h"
#include "preprocess/normals/signed_forest.h"
#include "preprocess/points/keep_points.h"

namespace relief {
namespace {

// A Kinect's points are three times as far apart at the far end of a room as at the near one: so
// deviations are of logarithms, and 5 of them keep the room's walls (office1: 0.3 % of all points
// go).
constexpr double kMaxDeviations = 5.0;
// The standard deviation of normal values over the median of their absolute deviations.
constexpr double kSigmaPerMad = 1.4826;
// At the border of a surface neighbours lie on one side: their mean distance grows by 1.4.
constexpr float kMaxNeighbours = 3.0F;
// Scan lines lie up to three points' distances apart.
constexpr float kLinkSpacings = 4.0F;
constexpr std::uint32_t kMinCluster = 50;

std::vector<float> mean_distances(const std::vector<glm::dvec3>& positions,
                                  const NeighbourGraph& graph) {
  std::vector<float> means(positions.size());
  tbb::parallel_for(std::size_t{0}, positions.size(), [&](std::size_t i) {
    double sum = 0.0;
    for (const std::uint32_t j : graph.of(i)) sum += glm::distance(positions[i], positions[j]);
    means[i] = static_cast<float>(sum / graph.k);
  });
  return means;
}

/// Points too far from their neighbours, compared with the whole scan.
double largest_mean(const std::vector<float>& means) {
  std::vector<double> logs(means.size());
  std::ranges::transform(means, logs.begin(), [](float d) { return std::log(double{d}); });
  const double median = median_of(logs);
  for (double& value : logs) value = std::abs(value - median);
  return std::exp(median + kMaxDeviations * kSigmaPerMad * median_of(logs));
}

std::vector<std::uint8_t> find_sparse(const std::vector<float>& means,
                                      const NeighbourGraph& graph) {
  // Even scans (grids) hardly deviate at all; points twice as sparse still count as even.
  const double largest = std::max(largest_mean(means), 3.0 * double{median_of(means)});
  std::vector<std::uint8_t> sparse(means.size());
  tbb::parallel_for(std::size_t{0}, means.size(), [&](std::size_t i) {
    std::vector<float> around;
    for (const std::uint32_t j : graph.of(i)) around.push_back(means[j]);
    sparse[i] = means[i] > largest || means[i] > kMaxNeighbours * median_of(std::move(around));
  });
  return sparse;
}

std::vector<std::uint8_t> find_small_clusters(const std::vector<glm::dvec3>& positions,
                                              const NeighbourGraph& graph,
                                              const std::vector<std::uint8_t>& sparse) {
  const auto count = static_cast<std::uint32_t>(positions.size());
  SignedForest clusters(count);  // no normals are flipped
  for (std::uint32_t i = 0; i < count; ++i) {
    if (sparse[i] != 0) continue;
    for (const std::uint32_t j : graph.of(i)) {
      const float reach = kLinkSpacings * std::min(graph.spacing[i], graph.spacing[j]);
      if (sparse[j] != 0 || glm::distance(positions[i], positions[j]) > double{reach}) continue;
      const SignedForest::Root a = clusters.find(i);
      const SignedForest::Root b = clusters.find(j);
      if (a.root != b.root) clusters.join(a, b, false);
    }
  }
  std::vector<std::uint32_t> sizes(count, 0);
  for (std::uint32_t i = 0; i < count; ++i)
    sizes[clusters.find(i).root] += sparse[i] == 0 ? 1U : 0U;
  std::vector<std::uint8_t> small(count);
  for (std::uint32_t i = 0; i < count; ++i)
    small[i] = sparse[i] == 0 && sizes[clusters.find(i).root] < kMinCluster;
  return small;
}

}  // namespace

OutlierReport remove_outliers(Points& points, Progress& progress) {
  OutlierReport report;
  if (points.size() < kMinSurfacePoints) return report;
  progress.begin_stage("clean", 0);
  const NeighbourGraph graph = find_neighbours(points.positions, kSurfaceNeighbours);
  std::vector<std::uint8_t> dropped = find_sparse(mean_distances(points.positions, graph), graph);
  const std::vector<std::uint8_t> small = find_small_clusters(points.positions, graph, dropped);
  const auto count = [](const std::vector<std::uint8_t>& marks) {
    return static_cast<std::uint64_t>(std::ranges::count(marks, 1));
  };
  report = {count(dropped), count(small), false};
  if (2 * (report.sparse + report.cluster) > points.size()) return {0, 0, true};
  for (std::size_t i = 0; i < small.size(); ++i) dropped[i] |= small[i];
  drop_points(points, dropped);
  return report;
}

}  // namespace relief
