// Which displays a context is tried of, and in which order, told by an EGL that is made up: no
// machine has them all.
#include "renderer/gl/context/egl.h"

#include <gtest/gtest.h>

#include <string_view>
#include <vector>

namespace relief {
namespace {

/// What the made-up EGL has. Its functions can hold nothing, so that this is global.
struct Machine {
  std::vector<const char*> devices;  ///< the extensions of each
  const char* extensions = "";       ///< of EGL itself
};
Machine machine;

/// A pointer that stands for device `i`, or for its display.
void* token(std::size_t i) {
  return reinterpret_cast<void*>(i + 1);
}
constexpr std::size_t kSurfaceless = 100;

EGLBoolean query_devices(EGLint most, EGLDeviceEXT* devices, EGLint* count) {
  *count = static_cast<EGLint>(machine.devices.size());
  EXPECT_LE(*count, most);
  for (std::size_t i = 0; i < machine.devices.size(); ++i) devices[i] = token(i);
  return EGL_TRUE;
}

const char* query_device_string(EGLDeviceEXT device, EGLint /*name*/) {
  return machine.devices.at(reinterpret_cast<std::size_t>(device) - 1);
}

EGLDisplay platform_display(EGLenum platform, void* device, const EGLint* /*attributes*/) {
  return platform == EGL_PLATFORM_DEVICE_EXT ? device : token(kSurfaceless);
}

__eglMustCastToProperFunctionPointerType function(const char* name) {
  using Function = __eglMustCastToProperFunctionPointerType;
  const std::string_view wanted(name);
  if (wanted == "eglQueryDevicesEXT") return reinterpret_cast<Function>(&query_devices);
  if (wanted == "eglQueryDeviceStringEXT") return reinterpret_cast<Function>(&query_device_string);
  if (wanted == "eglGetPlatformDisplayEXT") return reinterpret_cast<Function>(&platform_display);
  return nullptr;
}

/// The displays of `has`, in the order in which they are tried.
std::vector<EGLDisplay> displays_of(const Machine& has) {
  machine = has;
  Egl egl;
  egl.get_proc_address = &function;
  egl.query_string = [](EGLDisplay, EGLint) { return machine.extensions; };
  return displays_without_window(egl);
}

constexpr const char* kGpu = "EGL_EXT_device_drm EGL_NV_device_cuda";
constexpr const char* kSoftware = "EGL_MESA_device_software EGL_EXT_device_drm_render_node";
constexpr const char* kMesa = "EGL_EXT_platform_device EGL_MESA_platform_surfaceless";

TEST(EglDisplays, GpuComesBeforeMesasPlatform) {
  const std::vector<EGLDisplay> expected{token(0), token(kSurfaceless), token(1)};
  EXPECT_EQ(displays_of({{kGpu, kSoftware}, kMesa}), expected);
}

TEST(EglDisplays, SoftwareComesLastWhereverItIsNamed) {
  const std::vector<EGLDisplay> expected{token(1), token(2), token(kSurfaceless), token(0)};
  EXPECT_EQ(displays_of({{kSoftware, kGpu, kGpu}, kMesa}), expected);
}

TEST(EglDisplays, GpuAloneNeedsNoMesa) {
  EXPECT_EQ(displays_of({{kGpu}, "EGL_EXT_platform_device"}), std::vector<EGLDisplay>{token(0)});
}

TEST(EglDisplays, MesasPlatformAloneNeedsNoDevices) {
  EXPECT_EQ(displays_of({{}, kMesa}), std::vector<EGLDisplay>{token(kSurfaceless)});
}

TEST(EglDisplays, NoneIsNone) {
  EXPECT_TRUE(displays_of({{}, ""}).empty());
}

}  // namespace
}  // namespace relief
