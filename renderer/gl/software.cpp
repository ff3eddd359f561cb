#include "renderer/gl/software.h"

namespace relief {

std::string renderer_name(const Gl& gl) {
  return reinterpret_cast<const char*>(gl.GetString(GL_RENDERER));
}

bool draws_on_cpu(const Gl& gl) {
  const std::string name = renderer_name(gl);
  return name.find("llvmpipe") != std::string::npos || name.find("softpipe") != std::string::npos;
}

}  // namespace relief
