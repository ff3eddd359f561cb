#include "preprocess/points/point_radii.h"

#include <algorithm>
#include <cassert>

namespace relief {
namespace {

constexpr double kSpacings = 1.2;

}  // namespace

std::vector<double> find_radii(const NeighbourGraph& graph) {
  assert(graph.k > 0 && "points have neighbours");
  std::vector<double> radii(graph.spacing.size());
  for (std::size_t i = 0; i < radii.size(); ++i) {
    double sum = 0.0;
    for (const std::uint32_t j : graph.of(i)) sum += graph.spacing[j];
    radii[i] = kSpacings * std::min(double{graph.spacing[i]}, 2.0 * sum / graph.k);
  }
  return radii;
}

}  // namespace relief
