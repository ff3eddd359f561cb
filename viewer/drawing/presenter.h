// Brings a picture into the window.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <utility>

#include "common/error.h"
#include "renderer/gl/object.h"
#include "viewer/drawing/canvas.h"

namespace relief {

/// How a picture is shown.
struct Presentation {
  double exposure = 0.0;  ///< stops
  double shade = 0.0;     ///< strength of eye-dome lighting by the canvas's depth; 0: none
};

/// Draws a canvas over the whole window, enlarged if it is smaller, as sRGB.
class Presenter {
 public:
  static Result<Presenter> create(const Gl& gl);

  /// `window`: its size in pixels. Leaves the window's framebuffer bound, and nothing else.
  void draw(const Canvas& canvas, glm::ivec2 window, const Presentation& how) const;

 private:
  Presenter(const Gl& gl, Program program, VertexArray nothing)
      : gl_(&gl), program_(std::move(program)), nothing_(std::move(nothing)) {}

  const Gl* gl_;
  Program program_;
  VertexArray nothing_;
};

}  // namespace relief
