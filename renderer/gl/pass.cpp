#include "renderer/gl/pass.h"

namespace relief {

namespace {

/// llvmpipe starts its timer when a thread begins its last tile: it said 0.2 ms of a frame of 10.
bool has_wrong_timer(const Gl& gl) {
  const GLubyte* const renderer = gl.GetString(GL_RENDERER);
  return std::string_view(reinterpret_cast<const char*>(renderer)).starts_with("llvmpipe");
}

}  // namespace

PassTimer::PassTimer(const Gl& gl) : gl_(&gl) {
  GLint bits = 0;
  gl.GetQueryiv(GL_TIME_ELAPSED, GL_QUERY_COUNTER_BITS, &bits);
  available_ = bits > 0 && !has_wrong_timer(gl);
}

std::optional<double> PassTimer::take() {
  if (!available_) return std::nullopt;
  double milliseconds = 0.0;
  for (const Query& query : queries_) {
    GLuint64 nanoseconds = 0;
    gl_->GetQueryObjectui64v(query.id(), GL_QUERY_RESULT, &nanoseconds);
    milliseconds += 1e-6 * static_cast<double>(nanoseconds);
  }
  queries_.clear();
  return milliseconds;
}

ScopedPass::ScopedPass(const Gl& gl, PassTimer& timer, std::string_view name)
    : gl_(gl), timed_(timer.available_) {
  gl_.PushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, static_cast<GLsizei>(name.size()),
                     name.data());
  if (!timed_) return;
  timer.queries_.emplace_back(gl, name, GLenum{GL_TIME_ELAPSED});
  gl_.BeginQuery(GL_TIME_ELAPSED, timer.queries_.back().id());
}

ScopedPass::~ScopedPass() {
  if (timed_) gl_.EndQuery(GL_TIME_ELAPSED);
  gl_.PopDebugGroup();
}

}  // namespace relief
