// Tells the surroundings of a region that lie above or below it from those that continue it.
#pragma once

#include "preprocess/resample/surroundings/point_grid.h"

namespace relief {

/// Moves surroundings of another sheet from the points that support samples to those that only
/// stabilise fits. A chin is one above the ground, to which a leg joins it: nodes below would take
/// its height. A point is of another sheet if it lies farther above or below the region's nearest
/// point on the base plane than the steeper slope of the two, at least 61 degrees, reaches over
/// their distance there and a spacing (docs/decisions/0153). `own`: over the region's points.
void drop_other_sheets(const PointGrid& own, PatchPoints& points);

}  // namespace relief
