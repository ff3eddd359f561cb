// Draws kernels on the CPU, for OpenGL that does so, too: two to ten times as fast as with shaders
// (docs/decisions/0154-volumes-on-the-cpu.md).
#pragma once

#include <memory>

#include "renderer/engines/volume/drawing.h"

namespace relief::volume {

/// Whether CpuDrawing draws this frame as volume-reference does: no slabs, no surface beside it,
/// and only the colour is asked for.
[[nodiscard]] bool is_for_cpu(const Gl& gl, const VolumeFrame& frame);

[[nodiscard]] std::unique_ptr<VolumeDrawing> make_cpu_drawing(const Gl& gl);

}  // namespace relief::volume
