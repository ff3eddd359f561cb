// What a picture is drawn into before it is shown.
#pragma once

#include <cstdint>

#include "common/error.h"
#include "renderer/gl/functions.h"
#include "renderer/gl/object.h"

namespace relief {

/// A picture twice: as the renderer draws it, with the depth that eye-dome lighting needs, and as
/// the window shows it.
struct Canvas {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  Texture colour;                 ///< linear light, half floats
  Texture depth;                  ///< of the surfaces, reversed (Viewport::draw)
  Framebuffer framebuffer;        ///< of colour and depth
  Texture shown;                  ///< the encoded colour: sRGB, 8 bits
  Framebuffer shown_framebuffer;  ///< of `shown`
};

/// Rows of a picture, from below.
struct Rows {
  std::uint32_t bottom = 0;
  std::uint32_t top = 0;  ///< the first above

  [[nodiscard]] bool empty() const { return bottom >= top; }
};

/// Sides of at least 1. Fails if OpenGL has no memory for it.
Result<Canvas> make_canvas(const Gl& gl, std::uint32_t width, std::uint32_t height);

}  // namespace relief
