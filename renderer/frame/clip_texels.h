// The clip lines of splats as shaders read them (shaders/include/clipping.glsl).
#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <span>

#include "common/error.h"
#include "renderer/clip/clip_partners.h"
#include "renderer/gl/functions.h"
#include "renderer/gl/object.h"

namespace relief {

/// The record of a splat: its first texel in the table of lines, how many lines there are, and of
/// what kind.
[[nodiscard]] glm::uvec2 clip_range(std::size_t first_texel, std::size_t lines, ClipKind kind);

/// The table of lines. Fails if there are more than OpenGL can hold: none are left out.
Result<Table> make_clip_lines(const Gl& gl, std::span<const glm::vec4> texels);

}  // namespace relief
