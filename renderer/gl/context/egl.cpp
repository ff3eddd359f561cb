#include "renderer/gl/context/egl.h"

#include <array>
#include <string_view>

#include "renderer/gl/context/library.h"

namespace relief {
namespace {

bool has_extension(const char* extensions, std::string_view name) {
  return extensions != nullptr && std::string_view(extensions).find(name) != std::string_view::npos;
}

/// All devices that EGL names; none if it can't.
std::vector<EGLDeviceEXT> devices_of(const Egl& egl) {
  const auto query_devices =
      reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(egl.get_proc_address("eglQueryDevicesEXT"));
  std::array<EGLDeviceEXT, 16> devices{};
  EGLint count = 0;
  if (query_devices == nullptr ||
      query_devices(static_cast<EGLint>(devices.size()), devices.data(), &count) != EGL_TRUE)
    return {};
  // Not a list in braces, which would hold the two iterators.
  return std::vector<EGLDeviceEXT>(devices.begin(), devices.begin() + count);
}

}  // namespace

Result<Egl> load_egl() {
  RELIEF_TRY_ASSIGN(const auto library, Library::open("libEGL.so.1"));
  Egl egl;
  library.find("eglGetProcAddress", egl.get_proc_address);
  library.find("eglQueryString", egl.query_string);
  library.find("eglGetError", egl.get_error);
  library.find("eglInitialize", egl.initialize);
  library.find("eglBindAPI", egl.bind_api);
  library.find("eglChooseConfig", egl.choose_config);
  library.find("eglCreateContext", egl.create_context);
  library.find("eglDestroyContext", egl.destroy_context);
  library.find("eglMakeCurrent", egl.make_current);
  if (egl.get_proc_address == nullptr || egl.query_string == nullptr || egl.get_error == nullptr ||
      egl.initialize == nullptr || egl.bind_api == nullptr || egl.choose_config == nullptr ||
      egl.create_context == nullptr || egl.destroy_context == nullptr ||
      egl.make_current == nullptr) {
    return Error{"libEGL.so.1 is incomplete"};
  }
  return egl;
}

std::vector<EGLDisplay> displays_without_window(const Egl& egl) {
  const auto get_platform_display = reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(
      egl.get_proc_address("eglGetPlatformDisplayEXT"));
  if (get_platform_display == nullptr) return {};
  const auto query_device_string = reinterpret_cast<PFNEGLQUERYDEVICESTRINGEXTPROC>(
      egl.get_proc_address("eglQueryDeviceStringEXT"));

  std::vector<EGLDisplay> displays;
  std::vector<EGLDisplay> software;
  for (EGLDeviceEXT device : devices_of(egl)) {
    const char* const extensions =
        query_device_string != nullptr ? query_device_string(device, EGL_EXTENSIONS) : nullptr;
    auto& found = has_extension(extensions, "EGL_MESA_device_software") ? software : displays;
    found.push_back(get_platform_display(EGL_PLATFORM_DEVICE_EXT, device, nullptr));
  }
  if (has_extension(egl.query_string(EGL_NO_DISPLAY, EGL_EXTENSIONS),
                    "EGL_MESA_platform_surfaceless")) {
    displays.push_back(
        get_platform_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
  }
  displays.insert(displays.end(), software.begin(), software.end());
  std::erase(displays, EGL_NO_DISPLAY);
  return displays;
}

}  // namespace relief
