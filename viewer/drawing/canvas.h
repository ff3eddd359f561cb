// What a picture is drawn into before it is shown.
#pragma once

#include <cstdint>

#include "common/error.h"
#include "renderer/gl/functions.h"
#include "renderer/gl/object.h"

namespace relief {

/// Linear light, half float, as the renderer's own targets, and depth for what needs it. Beside it
/// the same as a window has it.
struct Canvas {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  Texture colour;
  Texture depth;
  Framebuffer framebuffer;
  Texture shown;  ///< sRGB, 8 bits
  Framebuffer shown_framebuffer;
};

/// Sides of at least 1. Fails if OpenGL has no memory for it.
Result<Canvas> make_canvas(const Gl& gl, std::uint32_t width, std::uint32_t height);

}  // namespace relief
