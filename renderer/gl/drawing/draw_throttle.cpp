#include "renderer/gl/drawing/draw_throttle.h"

#include <utility>

#include "renderer/gl/software.h"

namespace relief {

DrawThrottle::DrawThrottle(const Gl& gl) : gl_(gl), is_needed_(draws_on_cpu(gl)) {}

DrawThrottle::~DrawThrottle() {
  if (before_ != nullptr) gl_.DeleteSync(before_);
}

void DrawThrottle::drew(std::uint64_t triangles) {
  if (!is_needed_) return;
  triangles_ += triangles;
  if (triangles_ < kTrianglesPerFence) return;
  triangles_ = 0;
  const GLsync before = std::exchange(before_, gl_.FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0));
  if (before == nullptr) return;
  gl_.ClientWaitSync(before, 0, GL_TIMEOUT_IGNORED);
  gl_.DeleteSync(before);
}

}  // namespace relief
