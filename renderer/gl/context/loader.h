// How functions of an OpenGL context are found.
#pragma once

#include <functional>

namespace relief {

using GlFunction = void (*)();

/// The address of an OpenGL function of the current context, or null. SDL_GL_GetProcAddress,
/// glfwGetProcAddress and eglGetProcAddress are such.
using GlLoader = std::function<GlFunction(const char* name)>;

}  // namespace relief
