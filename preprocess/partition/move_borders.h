// Moves borders between regions so that they are shorter and points suit their region better.
#pragma once

#include <vector>

#include "preprocess/partition/region.h"
#include "preprocess/partition/region_criteria.h"

namespace relief {

/// Weights of the terms of a border's cost.
struct BorderWeights {
  double stretch;  ///< of a point's stretch (its surface area over the area on the base plane),
                   ///< relative to the border of a single point
  double crease;   ///< a border across which normals turn by 90 degrees counts as shorter by a
                   ///< factor of 1 + this
};

/// Moves points at borders to a neighbouring region if stretch and border length decrease (Besag's
/// iterated conditional modes, 1986) and the region keeps its normal cone and stays single-valued.
/// Drops regions that become empty. Regions may fall apart (see part_components). Refits their
/// normals. The result does not depend on the number of threads.
void move_borders(const SurfaceSamples& samples, const NeighbourGraph& graph, double cone_degrees,
                  const BorderWeights& weights, std::vector<Region>& regions);

}  // namespace relief
