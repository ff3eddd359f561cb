// OpenGL by EGL without a surface: Mesa's surfaceless platform, else a device (GPUs of NVIDIA).
#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <array>
#include <string_view>
#include <utility>

#include "renderer/gl/context.h"
#include "renderer/gl/library.h"

namespace relief {
namespace {

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

/// A display that needs no window system, initialised; EGL_NO_DISPLAY if there is none.
EGLDisplay open_display(const Egl& egl) {
  const auto get_platform_display = reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(
      egl.get_proc_address("eglGetPlatformDisplayEXT"));
  const char* const extensions = egl.query_string(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  if (get_platform_display == nullptr || extensions == nullptr) return EGL_NO_DISPLAY;
  const std::string_view all(extensions);
  const auto initialised = [&egl](EGLDisplay display) {
    return display != EGL_NO_DISPLAY && egl.initialize(display, nullptr, nullptr) == EGL_TRUE;
  };
  if (all.find("EGL_MESA_platform_surfaceless") != std::string_view::npos) {
    EGLDisplay display =
        get_platform_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (initialised(display)) return display;
  }
  const auto query_devices =
      reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(egl.get_proc_address("eglQueryDevicesEXT"));
  if (query_devices == nullptr) return EGL_NO_DISPLAY;
  std::array<EGLDeviceEXT, 16> devices{};
  EGLint count = 0;
  if (query_devices(static_cast<EGLint>(devices.size()), devices.data(), &count) != EGL_TRUE)
    return EGL_NO_DISPLAY;
  for (EGLint i = 0; i < count; ++i) {
    EGLDisplay display = get_platform_display(EGL_PLATFORM_DEVICE_EXT,
                                              devices[static_cast<std::size_t>(i)], nullptr);
    if (initialised(display)) return display;
  }
  return EGL_NO_DISPLAY;
}

/// The display is left open: EGL hands the same one to everyone in the process, and closing it
/// would take the contexts of others with it.
class EglContext final : public GlContext {
 public:
  EglContext(const Egl& egl, EGLDisplay display, EGLContext context)
      : egl_(egl), display_(display), context_(context) {}
  ~EglContext() override {
    egl_.make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    egl_.destroy_context(display_, context_);
  }
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;

  [[nodiscard]] GlFunction get_proc_address(const char* name) const override {
    return egl_.get_proc_address(name);
  }
  [[nodiscard]] const char* name() const override { return "EGL"; }

 private:
  Egl egl_;
  EGLDisplay display_;
  EGLContext context_;
};

}  // namespace

Result<std::unique_ptr<GlContext>> make_egl_context(bool debug) {
  const auto egl = load_egl();
  if (!egl) return make_error("EGL: {}", egl.error().message);
  EGLDisplay display = open_display(*egl);
  if (display == EGL_NO_DISPLAY) return Error{"EGL: no display without a window system"};
  if (egl->bind_api(EGL_OPENGL_API) != EGL_TRUE) return Error{"EGL: no desktop OpenGL"};

  const std::array<EGLint, 5> wanted{EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, 0,
                                     EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  if (egl->choose_config(display, wanted.data(), &config, 1, &count) != EGL_TRUE || count == 0)
    return Error{"EGL: no configuration for desktop OpenGL"};

  const std::array<EGLint, 9> attributes{EGL_CONTEXT_MAJOR_VERSION,
                                         4,
                                         EGL_CONTEXT_MINOR_VERSION,
                                         5,
                                         EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                         EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                         EGL_CONTEXT_OPENGL_DEBUG,
                                         debug ? EGL_TRUE : EGL_FALSE,
                                         EGL_NONE};
  EGLContext context = egl->create_context(display, config, EGL_NO_CONTEXT, attributes.data());
  if (context == EGL_NO_CONTEXT)
    return make_error("EGL: no OpenGL 4.5 core context, error {:#x}", egl->get_error());
  if (egl->make_current(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) != EGL_TRUE) {
    egl->destroy_context(display, context);
    return make_error("EGL: no context without a surface, error {:#x}", egl->get_error());
  }
  return std::unique_ptr<GlContext>(std::make_unique<EglContext>(*egl, display, context));
}

}  // namespace relief
