// From several samples a pixel to their mean, on the GPU.
#pragma once

#include <cstdint>

#include "common/error.h"
#include "renderer/gl/drawing/pass.h"
#include "renderer/gl/functions.h"
#include "renderer/gl/object.h"
#include "renderer/view/view.h"

namespace relief {

/// An image's colour and coverage, half float, while its parts are resolved into it.
struct ResolvedColour {
  Framebuffer framebuffer;
  Texture colour;
};

/// Fails if OpenGL has no memory for it.
Result<ResolvedColour> make_resolved(const Gl& gl, std::uint32_t width, std::uint32_t height);

/// Averages the samples of pixels: linear light and coverage, both premultiplied, in 32 bits.
class Resolve {
 public:
  static Result<Resolve> create(const Gl& gl);

  /// Reads the part's `samples` and writes its pixels into the image of the framebuffer; leaves no
  /// framebuffer bound.
  void draw(PassTimer& timer, const Texture& samples, const Raster& part, GLuint framebuffer) const;

 private:
  Resolve(const Gl& gl, Program program, VertexArray nothing)
      : gl_(&gl), program_(std::move(program)), nothing_(std::move(nothing)) {}
  const Gl* gl_;
  Program program_;
  VertexArray nothing_;
};

/// What resolves one part; what it points to must outlive it.
struct PartResolve {
  const Resolve* resolve = nullptr;
  GLuint framebuffer = 0;  ///< of the whole image
  Raster part;

  void draw(PassTimer& timer, const Texture& samples) const {
    resolve->draw(timer, samples, part, framebuffer);
  }
};

}  // namespace relief
