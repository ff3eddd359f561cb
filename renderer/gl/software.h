// OpenGL that draws on the CPU: Mesa's llvmpipe and softpipe.
#pragma once

#include <string>

#include "renderer/gl/functions.h"

namespace relief {

/// OpenGL's name for itself.
[[nodiscard]] std::string renderer_name(const Gl& gl);

/// Whether it draws on the CPU, in the memory of this process.
[[nodiscard]] bool draws_on_cpu(const Gl& gl);

}  // namespace relief
