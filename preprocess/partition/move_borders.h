// Borders between regions, made shorter and moved to where both sides suit their points better.
#pragma once

#include <vector>

#include "preprocess/partition/partition.h"

namespace relief {

/// How borders weigh what they part.
struct BorderWeights {
  double stretch;  ///< of a point's stretch, the area of its surface over that of the base plane
                   ///< below, beside the border that a point alone would have
  double crease;   ///< how much shorter a border counts across which normals turn by 90 degrees: by
                   ///< a factor of 1 + this
};

/// Lets points at borders join a neighbouring region, each where stretch and border then are less
/// (Besag's iterated conditional modes, 1986), as long as the region keeps its normal cone and its
/// single height. Regions may get empty (these are dropped) or fall apart (see part_components).
/// Their normals are fitted anew. The result does not depend on the number of threads.
void move_borders(const SurfaceSamples& samples, const NeighbourGraph& graph, double cone_degrees,
                  const BorderWeights& weights, std::vector<Region>& regions);

}  // namespace relief
