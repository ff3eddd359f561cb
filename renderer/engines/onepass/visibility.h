// What cells find before it is shaded: a visibility buffer.
#pragma once

#include "common/error.h"
#include "renderer/gl/functions.h"
#include "renderer/gl/object.h"
#include "renderer/targets.h"

namespace relief::onepass {

/// One for each picture, of its size. It is never cleared: where the depth buffer is, nothing reads
/// it.
struct Visibility {
  Texture found;            ///< RGBA32F: grid coordinates, entry of the patch table, depth
  Framebuffer framebuffer;  ///< it and the picture's depth buffer
};

/// Makes it; `targets` must outlive it. Fails if OpenGL lacks memory.
Result<Visibility> make_visibility(const Gl& gl, const Targets& targets);

}  // namespace relief::onepass
