// The OpenGL state of someone else, put aside while Relief draws.
#pragma once

#include <array>
#include <vector>

#include "renderer/gl/functions.h"

namespace relief {

/// While it lives, the state that passes depend on is OpenGL's initial one; then it is again what
/// it was: framebuffers, viewport, program, vertex array, indirect buffer, depth, blending, faces,
/// clip control, masks, scissor, stencil. Texture units, and the uniform and storage buffers that
/// Relief binds, are left unbound instead.
class SavedState {
 public:
  explicit SavedState(const Gl& gl);
  ~SavedState();
  SavedState(const SavedState&) = delete;
  SavedState& operator=(const SavedState&) = delete;

 private:
  [[nodiscard]] GLint get(GLenum name) const;

  const Gl& gl_;
  std::vector<GLenum> enabled_;
  std::array<GLint, 4> viewport_{};
  std::array<GLboolean, 4> colour_mask_{};
  GLboolean depth_mask_ = GL_TRUE;
  GLint draw_framebuffer_;
  GLint read_framebuffer_;
  GLint program_;
  GLint vertex_array_;
  GLint commands_;
  GLint depth_func_;
  GLint culled_face_;
  GLint front_face_;
  GLint clip_origin_;
  GLint clip_depth_;
  std::array<GLint, 4> blend_factors_;    ///< source and destination of colour, then of alpha
  std::array<GLint, 2> blend_equations_;  ///< of colour, of alpha
};

}  // namespace relief
