// The legend of an image that is coloured by a scalar.
#pragma once

#include "common/image/image.h"
#include "common/scalars/colour_scale.h"

namespace relief {

/// Draws a legend into the lower right corner of an image with channels R, G and B: the scalar's
/// name over a bar with numbers, or over a list of labels. A dark panel makes it readable on any
/// background. Returns false, and draws nothing, if the image is too small for readable text.
[[nodiscard]] bool draw_legend(const ColourScale& scale, Image& image);

}  // namespace relief
