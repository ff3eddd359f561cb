// OpenGL by EGL without a surface, of the first display that has it.
#include <array>
#include <utility>

#include "renderer/gl/context/context.h"
#include "renderer/gl/context/egl.h"

namespace relief {
namespace {

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

/// `tells_of_resets`: the context is lost if the GPU is reset, which is then known
/// (check_errors). Not all drivers have such contexts.
EGLContext create_context(const Egl& egl, EGLDisplay display, EGLConfig config, bool debug,
                          bool tells_of_resets) {
  const std::array<EGLint, 11> attributes{
      EGL_CONTEXT_MAJOR_VERSION,
      4,
      EGL_CONTEXT_MINOR_VERSION,
      5,
      EGL_CONTEXT_OPENGL_PROFILE_MASK,
      EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
      EGL_CONTEXT_OPENGL_DEBUG,
      debug ? EGL_TRUE : EGL_FALSE,
      tells_of_resets ? EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY : EGL_NONE,
      EGL_LOSE_CONTEXT_ON_RESET,
      EGL_NONE};
  return egl.create_context(display, config, EGL_NO_CONTEXT, attributes.data());
}

Result<std::unique_ptr<GlContext>> make_context_of(const Egl& egl, EGLDisplay display, bool debug) {
  if (egl.initialize(display, nullptr, nullptr) != EGL_TRUE)
    return make_error("EGL: no display without a window system, error {:#x}", egl.get_error());

  const std::array<EGLint, 5> wanted{EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, 0,
                                     EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  if (egl.choose_config(display, wanted.data(), &config, 1, &count) != EGL_TRUE || count == 0)
    return Error{"EGL: no configuration for desktop OpenGL"};

  EGLContext context = create_context(egl, display, config, debug, true);
  if (context == EGL_NO_CONTEXT) context = create_context(egl, display, config, debug, false);
  if (context == EGL_NO_CONTEXT)
    return make_error("EGL: no OpenGL 4.5 core context, error {:#x}", egl.get_error());
  if (egl.make_current(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) != EGL_TRUE) {
    egl.destroy_context(display, context);
    return make_error("EGL: no context without a surface, error {:#x}", egl.get_error());
  }
  return std::unique_ptr<GlContext>(std::make_unique<EglContext>(egl, display, context));
}

}  // namespace

Result<std::unique_ptr<GlContext>> make_egl_context(bool debug) {
  const auto egl = load_egl();
  if (!egl) return make_error("EGL: {}", egl.error().message);
  if (egl->bind_api(EGL_OPENGL_API) != EGL_TRUE) return Error{"EGL: no desktop OpenGL"};

  Result<std::unique_ptr<GlContext>> context = Error{"EGL: no display without a window system"};
  for (EGLDisplay display : displays_without_window(*egl)) {
    context = make_context_of(*egl, display, debug);
    if (context) break;
  }
  return context;
}

}  // namespace relief
