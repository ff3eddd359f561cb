// A scan's points as a volume: what kernels need to know of their neighbourhoods.
#pragma once

#include <string_view>

#include "common/error.h"
#include "common/points.h"
#include "common/progress.h"
#include "common/volume/scalar_volume.h"

namespace relief {

/// Neighbours from which a point's share of space and its gradient are found: with fewer, spacings
/// scatter; with more, they do not follow the density.
inline constexpr std::uint32_t kSpaceNeighbours = 32;
/// Fewer points enclose no volume.
inline constexpr std::size_t kMinVolumePoints = 4;

/// Makes a volume of distinct points and a scalar that they have, whose values become floats. A
/// point's share of space is the ball up to its farthest neighbour, divided by the points in it,
/// and less at the border, where part of the ball is empty. It is at most kMostOfMean^3 times what
/// its neighbours have, so that strays do not fill the image. Gradients are those of the linear
/// function that fits the neighbours best. Fails, with a clause, if there are too few points, if
/// coordinates are beyond 1e30, if they would take more than half of this machine's memory, or if
/// the user interrupts.
Result<ScalarVolume> volume_of_points(Points points, std::string_view scalar, Progress& progress);

/// The largest spacing of a point, in those of its neighbours.
inline constexpr double kMostOfMean = 2.0;

}  // namespace relief
