// Radii of the surface that points represent.
#pragma once

#include <vector>

#include "common/neighbours/neighbours.h"

namespace relief {

/// Returns the radius h of each point, world units: 1.2 times the local spacing, from the distance
/// to the 8th neighbour ([Zwicker 2001], section 5: h from the distances in a small neighbourhood).
/// A radius of only one spacing leaves sparse parts of a scan transparent (measured:
/// docs/decisions/0073). An outlier's radius is at most twice its neighbours' mean, so that it
/// stays small. Every point has a neighbour.
[[nodiscard]] std::vector<double> find_radii(const NeighbourGraph& graph);

}  // namespace relief
