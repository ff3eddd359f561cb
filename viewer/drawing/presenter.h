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
  double exposure = 0.0;     ///< stops
  double shade = 0.0;        ///< strength of eye-dome lighting by the canvas's depth; 0: none
  double depth_scale = 0.0;  ///< of an orthographic camera: eye_dome_scale() (renderer/eye_dome.h)
                             ///< times what depth values from 1 to 0 stand for
  double from = 0.0;         ///< the part of the width that is drawn, as shares of it
  double to = 1.0;
};

/// Draws a canvas over the window, enlarged if it is smaller, as sRGB.
class Presenter {
 public:
  static Result<Presenter> create(const Gl& gl);

  /// `window`: the size of the picture in it, in pixels, from its lower left corner. Leaves the
  /// window's framebuffer bound, and nothing else.
  void draw(const Canvas& canvas, glm::ivec2 window, const Presentation& how) const;

 private:
  Presenter(const Gl& gl, Program program, VertexArray nothing)
      : gl_(&gl), program_(std::move(program)), nothing_(std::move(nothing)) {}

  const Gl* gl_;
  Program program_;
  VertexArray nothing_;
};

}  // namespace relief
