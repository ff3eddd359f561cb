// EGL without a surface: its functions, and the displays that a context can come from.
#pragma once

#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <vector>

#include "common/error.h"

namespace relief {

/// The functions of EGL that we call.
struct Egl {
  decltype(eglGetProcAddress)* get_proc_address = nullptr;
  decltype(eglQueryString)* query_string = nullptr;
  decltype(eglGetError)* get_error = nullptr;
  decltype(eglInitialize)* initialize = nullptr;
  decltype(eglBindAPI)* bind_api = nullptr;
  decltype(eglChooseConfig)* choose_config = nullptr;
  decltype(eglCreateContext)* create_context = nullptr;
  decltype(eglDestroyContext)* destroy_context = nullptr;
  decltype(eglMakeCurrent)* make_current = nullptr;
};

Result<Egl> load_egl();

/// The displays that need no window system, best first and not yet initialised: the GPUs, then
/// Mesa's surfaceless platform, then devices that are software. Mesa's platform does not come first
/// because beside another vendor's driver, which most machines with an NVIDIA GPU have, it draws
/// on the CPU.
std::vector<EGLDisplay> displays_without_window(const Egl& egl);

}  // namespace relief
