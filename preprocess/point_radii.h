// How large a piece of surface each point of a scan stands for.
#pragma once

#include <vector>

#include "preprocess/neighbours.h"

namespace relief {

/// The side h of the square that each point stands for, world units: the local spacing, from the
/// distance to the 8th neighbour (paper 000, section 5: h from the distances in a small
/// neighbourhood). An outlier's is no more than twice its neighbours' mean, so that it stays a
/// speck. Every point has a neighbour.
[[nodiscard]] std::vector<double> find_radii(const NeighbourGraph& graph);

}  // namespace relief
