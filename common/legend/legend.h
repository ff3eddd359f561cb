// The legend of an image that is coloured by a scalar.
#pragma once

#include <optional>

#include "common/image/image.h"
#include "common/scalars/colour_scale.h"

namespace relief {

/// A corner of an image.
struct LegendCorner {
  bool is_left = false;
  bool is_top = false;
};

/// Draws a legend into a corner of an image with channels R, G and B: the scalar's name over a bar
/// with numbers, or over a list of labels. A dark panel makes it readable on any background.
/// Returns false, and draws nothing, if the image is too small for readable text.
///
/// `corner`: without a value, it becomes the one where the legend hides least: of the lower right,
/// upper right, lower left and upper left the first with the fewest pixels unlike that in the
/// corner itself. Frames of a film share it.
[[nodiscard]] bool draw_legend(const ColourScale& scale, Image& image,
                               std::optional<LegendCorner>& corner);

}  // namespace relief
