// Draws kernels on the CPU, for OpenGL that does so, too: two to ten times as fast as with shaders
// (docs/decisions/0154-volumes-on-the-cpu.md).
#pragma once

#include <memory>

#include "renderer/engines/volume/drawing.h"

namespace relief::volume {

/// Whether CpuDrawing draws these kernels: as volume-reference does, but no slabs.
[[nodiscard]] bool is_for_cpu(const Gl& gl, const KernelCloud& cloud,
                              const VolumeSettings& settings);

[[nodiscard]] std::unique_ptr<VolumeDrawing> make_cpu_drawing(const Gl& gl);

}  // namespace relief::volume
