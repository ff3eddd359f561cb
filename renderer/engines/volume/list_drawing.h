// Draws any kernels in any order: one pass over the image, each pixel composites its tile's list.
#pragma once

#include <memory>

#include "renderer/engines/volume/drawing.h"

namespace relief::volume {

[[nodiscard]] std::unique_ptr<VolumeDrawing> make_list_drawing(const Gl& gl);

}  // namespace relief::volume
