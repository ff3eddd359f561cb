// How far the surface reaches that each point of a scan stands for.
#pragma once

#include <vector>

#include "preprocess/points/neighbours.h"

namespace relief {

/// The radius h of each point, world units: 1.2 times the local spacing, from the distance to the
/// 8th neighbour (paper 000, section 5: h from the distances in a small neighbourhood). With the
/// spacing itself the sparser spots of a scan let what is behind them through (measured:
/// docs/decisions.md). An outlier's is no more than twice its neighbours' mean, so that it stays a
/// speck. Every point has a neighbour.
[[nodiscard]] std::vector<double> find_radii(const NeighbourGraph& graph);

}  // namespace relief
