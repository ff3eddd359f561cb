// Draws kernels on the CPU, for OpenGL that does so, too: two to ten times as fast as with shaders
// (docs/decisions/0154-volumes-on-the-cpu.md).
#pragma once

#include <memory>

#include "renderer/engines/volume/drawing.h"

namespace relief::volume {

/// Whether CpuDrawing draws these kernels: as volume-reference does, but no slabs.
[[nodiscard]] bool is_for_cpu(const Gl& gl, const KernelCloud& cloud,
                              const VolumeSettings& settings);

class CpuDrawing : public VolumeDrawing {
 public:
  /// Of a frame of one pixel: the depth along the view axis (world units) where half of what is
  /// behind is covered; infinite if nothing covers so much.
  [[nodiscard]] virtual float depth_of_pixel(const VolumeFrame& frame) = 0;
};

[[nodiscard]] std::unique_ptr<CpuDrawing> make_cpu_drawing(const Gl& gl);

}  // namespace relief::volume
