#include "renderer/gl/functions.h"

#include "renderer/gl/context/context.h"

namespace relief {

Result<Gl> load_functions(const GlContext& context, GlRecorder* recorder) {
  Gl gl;
  gl.recorder = recorder;
  const char* missing = nullptr;
#define RELIEF_GL_LOAD(type, name)                                        \
  gl.name = reinterpret_cast<type>(context.get_proc_address("gl" #name)); \
  if (gl.name == nullptr) missing = "gl" #name;
  RELIEF_GL_FUNCTIONS(RELIEF_GL_LOAD)
#undef RELIEF_GL_LOAD
#define RELIEF_GL_LOAD(type, name, hear)                                                 \
  const auto load_##name = reinterpret_cast<type>(context.get_proc_address("gl" #name)); \
  if (load_##name == nullptr) missing = "gl" #name;                                      \
  gl.name = {load_##name, recorder};
  RELIEF_GL_HEARD_FUNCTIONS(RELIEF_GL_LOAD)
#undef RELIEF_GL_LOAD
  if (missing != nullptr) {
    return make_error("OpenGL from {} has no {}; Relief needs OpenGL 4.5", context.name(), missing);
  }
  const GLint version = 10 * get_limit(gl, GL_MAJOR_VERSION) + get_limit(gl, GL_MINOR_VERSION);
  if (version < 45) {
    return make_error("OpenGL from {} has version {}.{}; Relief needs 4.5", context.name(),
                      version / 10, version % 10);
  }
  return gl;
}

GLint get_limit(const Gl& gl, GLenum name) {
  GLint value = 0;
  gl.GetIntegerv(name, &value);
  return value;
}

Status check_errors(const Gl& gl, const char* job) {
  const GLenum code = gl.GetError();
  if (code == GL_CONTEXT_LOST || gl.GetGraphicsResetStatus() != GL_NO_ERROR) {
    return make_error(
        "the GPU was reset at {}, by this program or another; try again, with a smaller image or "
        "scan if it happens again",
        job);
  }
  if (code == GL_NO_ERROR) return {};
  if (code == GL_OUT_OF_MEMORY) return make_error("OpenGL has not enough memory for {}", job);
  return make_error("OpenGL reports error {:#x} at {}; this is a mistake in Relief", code, job);
}

}  // namespace relief
