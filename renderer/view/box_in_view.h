// What of a box of a model an image can show.
#pragma once

#include "common/bounds.h"
#include "common/transform.h"
#include "renderer/view/view.h"

namespace relief {

/// A box of a model's frame, which `transform` places in the world.
struct PlacedBox {
  Bounds box;
  Transform transform;
};

/// Whether the image can show a point (world) within `reach` of the box. Some boxes beside an edge
/// of the image's frustum count as seen.
[[nodiscard]] bool sees_box(const View& view, const PlacedBox& placed, double reach);

/// Returns the depth at which the box is nearest to the eye, below 0 behind it: no point of the box
/// that the image shows is nearer. Beside the eye of a perspective camera the image shows nothing.
[[nodiscard]] double nearest_depth(const View& view, const PlacedBox& placed);

}  // namespace relief
