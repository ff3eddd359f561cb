#include "common/neighbours/neighbours.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "common/neighbours/morton.h"
#include "common/neighbours/nearest_search.h"
#include "common/neighbours/position_tree.h"

namespace relief {
namespace {

// Up to this many neighbours give the density: enough to average noise out, few enough to follow
// it.
constexpr std::uint32_t kDensityNeighbours = 8;

/// Fills the neighbours of those points that `is_wanted`.
template <class IsWanted>
void search(const PositionTree& tree, const IsWanted& is_wanted, NeighbourGraph& graph) {
  // In the order of the tree's leaves, so that a search finds in the cache what the last one read.
  tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, tree.size(), 1024),
                    [&](const auto& range) {
                      NearestSearch nearest(tree, graph.k);
                      for (std::uint32_t slot = range.begin(); slot != range.end(); ++slot) {
                        const std::uint32_t i = tree.index(slot);
                        if (!is_wanted(i)) continue;
                        nearest.find(slot);
                        std::uint32_t* out = graph.indices.data() + std::size_t{i} * graph.k;
                        for (std::uint32_t m = 0; m < graph.k; ++m)
                          out[m] = tree.index(nearest.slot(m));
                      }
                    });
}

/// Computes the spacing from the neighbours.
void set_spacing(const std::vector<glm::dvec3>& positions, NeighbourGraph& graph) {
  const auto n = static_cast<std::uint32_t>(positions.size());
  const std::uint32_t density_k = std::min(kDensityNeighbours, graph.k);
  std::vector<float> raw_spacing(n);
  tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, n, 4096), [&](const auto& range) {
    for (std::uint32_t i = range.begin(); i != range.end(); ++i) {
      const glm::dvec3 apart = positions[graph.of(i)[density_k - 1]] - positions[i];
      raw_spacing[i] =
          static_cast<float>(std::sqrt(std::numbers::pi * glm::dot(apart, apart) / density_k));
    }
  });

  // Half its own, half its neighbours' mean: a single r_8 scatters by about 20 % on random samples,
  // the mean alone takes a sparse border for as dense as its surroundings.
  graph.spacing.resize(n);
  tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, n, 4096), [&](const auto& range) {
    for (std::uint32_t i = range.begin(); i != range.end(); ++i) {
      float sum = 0.0F;
      for (const std::uint32_t j : graph.of(i)) sum += raw_spacing[j];
      graph.spacing[i] = 0.5F * (raw_spacing[i] + sum / static_cast<float>(graph.k));
    }
  });
}

}  // namespace

NeighbourGraph find_neighbours(const std::vector<glm::dvec3>& positions, std::uint32_t k) {
  const auto n = static_cast<std::uint32_t>(positions.size());
  NeighbourGraph graph;
  graph.k = n > 0 ? std::min(k, n - 1) : 0;
  if (graph.k == 0) return graph;
  graph.indices.resize(std::size_t{n} * graph.k);
  search(
      PositionTree(positions), [](std::uint32_t) { return true; }, graph);
  set_spacing(positions, graph);
  return graph;
}

NeighbourGraph neighbours_after_drop(const NeighbourGraph& graph,
                                     const std::vector<std::uint8_t>& dropped,
                                     const std::vector<glm::dvec3>& positions) {
  if (graph.k == 0 || positions.size() <= graph.k) return find_neighbours(positions, graph.k);
  std::vector<std::uint32_t> kept;  // by new index
  std::vector<std::uint32_t> new_index(dropped.size());
  for (std::uint32_t i = 0; i < dropped.size(); ++i) {
    new_index[i] = static_cast<std::uint32_t>(kept.size());
    if (dropped[i] == 0) kept.push_back(i);
  }
  NeighbourGraph left{graph.k, std::vector<std::uint32_t>(kept.size() * graph.k), {}};
  std::vector<std::uint8_t> is_lost(kept.size(), 0);  // lost a neighbour
  tbb::parallel_for(std::size_t{0}, kept.size(), [&](std::size_t i) {
    std::uint32_t* out = left.indices.data() + i * left.k;
    for (const std::uint32_t j : graph.of(kept[i])) {
      is_lost[i] |= dropped[j];
      *out++ = new_index[j];
    }
  });
  search(
      PositionTree(positions), [&is_lost](std::uint32_t i) { return is_lost[i] != 0; }, left);
  set_spacing(positions, left);
  return left;
}

NeighbourGraph reordered(const NeighbourGraph& graph, std::span<const std::uint32_t> order) {
  const std::vector<std::uint32_t> places = places_in(order);
  NeighbourGraph other{graph.k, std::vector<std::uint32_t>(graph.indices.size()),
                       std::vector<float>(graph.spacing.size())};
  tbb::parallel_for(std::size_t{0}, order.size(), [&](std::size_t k) {
    std::ranges::transform(graph.of(order[k]), other.indices.data() + k * graph.k,
                           [&](std::uint32_t j) { return places[j]; });
    other.spacing[k] = graph.spacing[order[k]];
  });
  return other;
}

std::vector<float> distances_to_eighth(const std::vector<glm::dvec3>& positions,
                                       const NeighbourGraph& graph) {
  std::vector<float> distances(positions.size());
  tbb::parallel_for(std::size_t{0}, positions.size(), [&](std::size_t i) {
    const std::uint32_t eighth = graph.of(i)[std::min(graph.k, 8U) - 1];
    distances[i] = static_cast<float>(glm::distance(positions[i], positions[eighth]));
  });
  return distances;
}

}  // namespace relief
