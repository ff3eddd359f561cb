// Draws kernels one behind the other as blended quads, sorted by the depth of their centres.
#pragma once

#include <memory>

#include "renderer/engines/volume/drawing.h"

namespace relief::volume {

/// Whether QuadDrawing can draw this frame: sorted kernels, and no outputs beside the colour.
[[nodiscard]] bool is_for_quads(const VolumeFrame& frame);

/// It blends on where a pixel lets less through than `min_transmittance`, and also the splat that
/// would end a pixel, which volume-reference leaves out.
[[nodiscard]] std::unique_ptr<VolumeDrawing> make_quad_drawing(const Gl& gl);

}  // namespace relief::volume
