// Brings a picture into the window.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
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

/// Brings a canvas into the window in two steps: light becomes sRGB at the canvas's own size, and
/// only where it has changed; then that is copied, enlarged if it is smaller. On llvmpipe all of
/// 1280x800 pixels take 20 ms.
class Presenter {
 public:
  static Result<Presenter> create(const Gl& gl);

  /// Makes what is shown of a canvas, in rows that have been drawn and, for eye-dome lighting, in
  /// those that lie so near that they see them.
  /// Fails if OpenGL can't compile a shader.
  Status encode(const Canvas& canvas, const Presentation& how, const Rows& rows);

  /// Copies it into the window, framebuffer 0, or another one. `window`: the size of the picture
  /// in it, in pixels, from its lower left corner.
  void copy(const Canvas& canvas, glm::ivec2 window, GLuint framebuffer = 0) const;

 private:
  Presenter(const Gl& gl, Program plain, Program copy, VertexArray nothing)
      : gl_(&gl), plain_(std::move(plain)), copy_(std::move(copy)), nothing_(std::move(nothing)) {}
  Result<const Program*> program_for(const Presentation& how);

  const Gl* gl_;
  Program plain_;
  /// With eye-dome lighting, once it is needed: llvmpipe compiles it for 0.1 s.
  std::optional<Program> shaded_;
  Program copy_;
  VertexArray nothing_;
};

}  // namespace relief
