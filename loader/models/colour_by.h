// Colours a scan or its patches by a scalar.
#pragma once

#include <optional>

#include "common/error.h"
#include "common/patch.h"
#include "common/points.h"
#include "common/scalars/colour_scale.h"
#include "common/scalars/scalar_names.h"
#include "common/stance.h"

namespace relief {

/// Returns what must be read from a scan for it.
[[nodiscard]] ScalarChoice scalars_for(const ColourBy& colour_by);

/// Returns the scale that follows from a scan's own values: its scalar, or the heights of its
/// points; nothing for kDistanceScalar, which only patches have. Errors are clauses.
Result<std::optional<ColourScale>> scale_of_points(const ColourBy& colour_by, const Points& points);

/// Replaces the colours of the points. Adds the labels that occur to the scale.
void paint_points(const ColourBy& colour_by, ColourScale& scale, Points& points);

/// Replaces the colours of the patches. `known`: the scale, if the scan's points gave it; otherwise
/// it follows from the patches. Returns the scale. Fails if the model does not have the scalar, as
/// a clause.
Result<ColourScale> paint_patches(const ColourBy& colour_by, std::optional<ColourScale> known,
                                  PatchModel& model);

}  // namespace relief
