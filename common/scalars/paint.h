// Gives patches the colours of a scalar.
#pragma once

#include <cstddef>
#include <functional>

#include "common/patch.h"
#include "common/scalars/colour_scale.h"

namespace relief {

/// Replaces the colours of all patches by those of scalar `number` of the model, and frees the
/// scalars. Texels without a value get kNoScalarColour. Adds the labels that occur at samples to
/// the scale. The colours of labels are not mixed where they meet (PatchModel::has_label_colours).
void paint_scalar(std::size_t number, ColourScale& scale, PatchModel& model);

/// Replaces the colours by those of the samples' heights, world z. A texel a node.
void paint_heights(const ColourScale& scale, PatchModel& model);

/// Returns the quantiles of all samples' world z; of nothing they are 0.
[[nodiscard]] Quantiles height_quantiles(const PatchModel& model);

}  // namespace relief
