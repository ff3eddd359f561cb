// Gives patches the colours of a scalar.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>

#include "common/patch.h"
#include "common/scalars/colour_scale.h"

namespace relief {

/// Replaces the colours of all patches by those of scalar `number` of the model, and frees the
/// scalars. Texels without a value get kNoScalarColour. Adds the labels that occur at samples to
/// the scale. The colours of labels are not mixed where they meet (PatchModel::has_label_colours).
void paint_scalar(std::size_t number, ColourScale& scale, PatchModel& model);

/// Replaces the colours by those of the samples' heights along `up` (unit, world). A texel a node.
void paint_heights(const ColourScale& scale, glm::dvec3 up, PatchModel& model);

/// Returns the quantiles of all samples' heights along `up`; 0 without samples.
[[nodiscard]] Quantiles height_quantiles(const PatchModel& model, glm::dvec3 up);

}  // namespace relief
