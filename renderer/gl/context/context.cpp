#include "renderer/gl/context/context.h"

#include <utility>

namespace relief {
namespace {

constexpr const char* kEglPackages = "libegl1 and libgl1-mesa-dri";
constexpr const char* kOsmesaPackage = "libosmesa6";

class AdoptedContext final : public GlContext {
 public:
  explicit AdoptedContext(GlLoader load) : load_(std::move(load)) {}
  [[nodiscard]] GlFunction get_proc_address(const char* name) const override { return load_(name); }
  [[nodiscard]] const char* name() const override { return "the application"; }

 private:
  GlLoader load_;
};

}  // namespace

std::unique_ptr<GlContext> adopt_context(const GlLoader& load) {
  return std::make_unique<AdoptedContext>(load);
}

Result<std::unique_ptr<GlContext>> make_context(GlPlatform platform, bool debug) {
  if (platform == GlPlatform::Osmesa) {
    auto osmesa = make_osmesa_context(debug);
    if (osmesa) return osmesa;
    return make_error("there is no OpenGL ({}); on Debian install {}", osmesa.error().message,
                      kOsmesaPackage);
  }
  auto egl = make_egl_context(debug);
  if (egl) return egl;
  if (platform == GlPlatform::Egl) {
    return make_error("there is no OpenGL ({}); on Debian install {}", egl.error().message,
                      kEglPackages);
  }
  auto osmesa = make_osmesa_context(debug);
  if (osmesa) return osmesa;
  return make_error("there is no OpenGL ({}; {}); on Debian install {}, or {}", egl.error().message,
                    osmesa.error().message, kEglPackages, kOsmesaPackage);
}

}  // namespace relief
