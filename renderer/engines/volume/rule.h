// The rule of compositing as shaders take it.
#pragma once

#include "renderer/engines/volume/drawing.h"
#include "shaders/volume/layout.h"

namespace relief::volume {

/// Largest peak and colour that are drawn: their products stay finite.
inline constexpr float kLargest = 1e15F;

/// Without slabs.
[[nodiscard]] shared::VolumeRule shader_rule(const VolumeFrame& frame);

/// One triangle over the image with a program, into targets. Textures are bound.
void draw_screen(const Gl& gl, const VolumeTargets& targets, const Program& program,
                 const Buffer& rule, const VertexArray& nothing);

}  // namespace relief::volume
