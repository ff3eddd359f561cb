#include "renderer/gl/debug.h"

namespace relief {
namespace {

void APIENTRY keep_first(GLenum /*source*/, GLenum /*type*/, GLuint /*id*/, GLenum severity,
                         GLsizei length, const GLchar* text, const void* first) {
  auto& kept = *static_cast<std::string*>(const_cast<void*>(first));
  if (severity != GL_DEBUG_SEVERITY_HIGH || !kept.empty()) return;
  kept = length < 0 ? std::string(text) : std::string(text, static_cast<std::size_t>(length));
}

}  // namespace

DebugLog::DebugLog(const Gl& gl) : gl_(gl) {
  gl_.Enable(GL_DEBUG_OUTPUT);
  gl_.Enable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
  gl_.DebugMessageCallback(keep_first, &first_);
}

DebugLog::~DebugLog() {
  gl_.DebugMessageCallback(nullptr, nullptr);
  gl_.Disable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
  gl_.Disable(GL_DEBUG_OUTPUT);
}

Status DebugLog::status() const {
  if (first_.empty()) return {};
  return make_error("OpenGL complains: {}", first_);
}

}  // namespace relief
