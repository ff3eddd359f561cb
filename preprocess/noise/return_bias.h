// Gives a smoothed surface back a part of what smoothing took from it.
#pragma once

#include <vector>

#include "common/neighbours/position_tree.h"
#include "common/progress.h"
#include "preprocess/noise/move_points.h"

namespace relief {

/// Moves smoothed points along their normals by the mean of their neighbours' residuals: smoothing
/// once more what smoothing left over (twicing, [Tukey 1977], "Exploratory Data Analysis").
///
/// Windows grow until their bias shows, so that ridges end too low and valleys too high. Residuals
/// are this bias, which neighbours share, and noise, whose mean is small. A mean that noise alone
/// explains is left out.
///
/// `tree`: the points as scanned; `spacing`: the scan's; `noise`: its standard deviation, all in
/// world units and, as `smooth`, by slot. Points that did not move stay. The result does not depend
/// on the number of threads.
void return_bias(const PositionTree& tree, const std::vector<float>& spacing,
                 const std::vector<float>& noise, SmoothPoints& smooth, Progress& progress);

}  // namespace relief
