#include "renderer/surfels/neighbour_sizes.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "common/neighbours/nearest_search.h"
#include "common/neighbours/neighbours.h"
#include "common/neighbours/position_tree.h"

namespace relief {
namespace {

constexpr std::uint32_t kMostNeighbours = 16;  // of a leftover
constexpr std::uint32_t kMeshNeighbours = 6;   // of a vertex of a mesh, on average
constexpr std::size_t kSpheresOfPiece = 1024;  // between looks at Ctrl-C

/// The diameter of a leftover whose neighbours `nearest` has found.
double leftover_size(const PositionTree& tree, const NearestSearch& nearest, std::uint32_t slot,
                     std::uint32_t k, SurfelSize method) {
  for (std::uint32_t farther = 1; farther < k; ++farther) {
    for (std::uint32_t nearer = 0; nearer < farther; ++nearer) {
      const SurfelTriangle triangle(tree.at(slot), tree.at(nearest.slot(nearer)),
                                    tree.at(nearest.slot(farther)));
      if (!triangle.is_collinear()) return diameter_of(triangle, method);
    }
  }
  const double first = std::sqrt(nearest.squared(0));
  const double second = std::sqrt(nearest.squared(std::min(1U, k - 1)));
  return method == SurfelSize::BspCircle ? second : 0.5 * (first + second);
}

}  // namespace

double diameter_of(const SurfelTriangle& triangle, SurfelSize method) {
  return method == SurfelSize::BspCircle ? triangle.circle_diameter() : triangle.mean_edge();
}

Status give_leftover_sizes(const std::vector<glm::dvec3>& positions,
                           std::span<const std::uint32_t> leftovers, SurfelSize method,
                           std::vector<double>& diameters, Progress& progress) {
  if (leftovers.empty()) return {};
  if (positions.size() == 1) {
    diameters.assign(1, 1.0);
    return {};
  }
  progress.begin_stage("surfels of leftovers", leftovers.size());
  const PositionTree tree(positions);
  std::vector<std::uint32_t> slots(positions.size());
  for (std::uint32_t slot = 0; slot < tree.size(); ++slot) slots[tree.index(slot)] = slot;
  const std::uint32_t k = std::min(kMostNeighbours, tree.size() - 1);
  using Range = tbb::blocked_range<std::size_t>;
  tbb::parallel_for(Range(0, leftovers.size(), kSpheresOfPiece), [&](const Range& range) {
    if (progress.cancelled()) return;
    NearestSearch nearest(tree, k);
    for (std::size_t m = range.begin(); m != range.end(); ++m) {
      const std::uint32_t slot = slots[leftovers[m]];
      nearest.find(slot);
      diameters[leftovers[m]] = leftover_size(tree, nearest, slot, k, method);
    }
    progress.advance(range.size());
  });
  if (progress.cancelled()) return interrupted_error();
  return {};
}

Result<std::vector<double>> find_qsplat_sizes(const std::vector<glm::dvec3>& positions,
                                              Progress& progress) {
  progress.begin_stage("surfel neighbours", 0);
  std::vector<double> diameters(positions.size(), 0.0);
  if (positions.size() < 2) {
    diameters.assign(positions.size(), 1.0);
    return diameters;
  }
  const NeighbourGraph graph = find_neighbours(positions, kMeshNeighbours);
  if (progress.cancelled()) return interrupted_error();
  for (std::uint32_t i = 0; i < positions.size(); ++i) {
    for (const std::uint32_t j : graph.of(i)) {
      const double edge = glm::distance(positions[i], positions[j]);
      diameters[i] = std::max(diameters[i], edge);
      diameters[j] = std::max(diameters[j], edge);
    }
  }
  return diameters;
}

}  // namespace relief
