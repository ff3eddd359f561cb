#include "renderer/gl/context.h"

#include <utility>

namespace relief {
namespace {

constexpr const char* kEglPackages = "libegl1 and libgl1-mesa-dri";
constexpr const char* kOsmesaPackage = "libosmesa6";

}  // namespace

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
