#include "renderer/gl/drawing/saved_state.h"

namespace relief {
namespace {

/// What OpenGL begins with turned off, and passes turn on and off or need off.
constexpr std::array<GLenum, 8> kSwitches{
    GL_BLEND,        GL_CULL_FACE,    GL_DEPTH_TEST,         GL_PROGRAM_POINT_SIZE,
    GL_SCISSOR_TEST, GL_STENCIL_TEST, GL_RASTERIZER_DISCARD, GL_TEXTURE_CUBE_MAP_SEAMLESS};

GLuint object_of(GLint name) {
  return static_cast<GLuint>(name);
}

GLenum enum_of(GLint name) {
  return static_cast<GLenum>(name);
}

}  // namespace

SavedState::SavedState(const Gl& gl)
    : gl_(gl),
      draw_framebuffer_(get(GL_DRAW_FRAMEBUFFER_BINDING)),
      read_framebuffer_(get(GL_READ_FRAMEBUFFER_BINDING)),
      program_(get(GL_CURRENT_PROGRAM)),
      vertex_array_(get(GL_VERTEX_ARRAY_BINDING)),
      commands_(get(GL_DRAW_INDIRECT_BUFFER_BINDING)),
      depth_func_(get(GL_DEPTH_FUNC)),
      culled_face_(get(GL_CULL_FACE_MODE)),
      front_face_(get(GL_FRONT_FACE)),
      clip_origin_(get(GL_CLIP_ORIGIN)),
      clip_depth_(get(GL_CLIP_DEPTH_MODE)),
      blend_factors_{get(GL_BLEND_SRC_RGB), get(GL_BLEND_DST_RGB), get(GL_BLEND_SRC_ALPHA),
                     get(GL_BLEND_DST_ALPHA)},
      blend_equations_{get(GL_BLEND_EQUATION_RGB), get(GL_BLEND_EQUATION_ALPHA)} {
  gl_.GetIntegerv(GL_VIEWPORT, viewport_.data());
  gl_.GetBooleanv(GL_COLOR_WRITEMASK, colour_mask_.data());
  gl_.GetBooleanv(GL_DEPTH_WRITEMASK, &depth_mask_);
  for (const GLenum what : kSwitches) {
    if (gl_.IsEnabled(what) == GL_TRUE) enabled_.push_back(what);
    gl_.Disable(what);
  }
  gl_.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  gl_.DepthMask(GL_TRUE);
  gl_.DepthFunc(GL_LESS);
  gl_.CullFace(GL_BACK);
  gl_.FrontFace(GL_CCW);
  gl_.ClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
  gl_.BlendFunc(GL_ONE, GL_ZERO);
  gl_.BlendEquationSeparate(GL_FUNC_ADD, GL_FUNC_ADD);
}

SavedState::~SavedState() {
  for (const GLenum what : kSwitches) gl_.Disable(what);
  for (const GLenum what : enabled_) gl_.Enable(what);
  gl_.BindFramebuffer(GL_DRAW_FRAMEBUFFER, object_of(draw_framebuffer_));
  gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, object_of(read_framebuffer_));
  gl_.UseProgram(object_of(program_));
  gl_.BindVertexArray(object_of(vertex_array_));
  gl_.BindBuffer(GL_DRAW_INDIRECT_BUFFER, object_of(commands_));
  gl_.Viewport(viewport_[0], viewport_[1], viewport_[2], viewport_[3]);
  gl_.ColorMask(colour_mask_[0], colour_mask_[1], colour_mask_[2], colour_mask_[3]);
  gl_.DepthMask(depth_mask_);
  gl_.DepthFunc(enum_of(depth_func_));
  gl_.CullFace(enum_of(culled_face_));
  gl_.FrontFace(enum_of(front_face_));
  gl_.ClipControl(enum_of(clip_origin_), enum_of(clip_depth_));
  gl_.BlendFuncSeparate(enum_of(blend_factors_[0]), enum_of(blend_factors_[1]),
                        enum_of(blend_factors_[2]), enum_of(blend_factors_[3]));
  gl_.BlendEquationSeparate(enum_of(blend_equations_[0]), enum_of(blend_equations_[1]));
}

GLint SavedState::get(GLenum name) const {
  return get_limit(gl_, name);
}

}  // namespace relief
