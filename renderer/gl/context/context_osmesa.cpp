// OpenGL by OSMesa: Mesa's software rasteriser as a plain library, where there is no EGL.
#include <GL/glcorearb.h>

#include <array>
#include <utility>

#include "renderer/gl/context/context.h"
#include "renderer/gl/context/library.h"

namespace relief {
namespace {

// From GL/osmesa.h, which is in a development package that nothing else needs.
using OsmesaContext = struct osmesa_context*;
constexpr int kOsmesaFormat = 0x22;
constexpr int kOsmesaProfile = 0x33;
constexpr int kOsmesaCoreProfile = 0x34;
constexpr int kOsmesaMajor = 0x36;
constexpr int kOsmesaMinor = 0x37;

struct Osmesa {
  OsmesaContext (*create_context)(const int* attributes, OsmesaContext share) = nullptr;
  void (*destroy_context)(OsmesaContext context) = nullptr;
  GLboolean (*make_current)(OsmesaContext context, void* pixels, GLenum type, GLsizei width,
                            GLsizei height) = nullptr;
  GlFunction (*get_proc_address)(const char* name) = nullptr;
};

/// OSMesa draws into the caller's memory; the images live in framebuffers of their own, so that
/// memory is one pixel.
using Pixel = std::array<GLubyte, 4>;

class OsmesaGlContext final : public GlContext {
 public:
  OsmesaGlContext(const Osmesa& osmesa, OsmesaContext context, std::unique_ptr<Pixel> pixel)
      : osmesa_(osmesa), context_(context), pixel_(std::move(pixel)) {}
  ~OsmesaGlContext() override {
    osmesa_.make_current(nullptr, nullptr, 0, 0, 0);
    osmesa_.destroy_context(context_);
  }
  OsmesaGlContext(const OsmesaGlContext&) = delete;
  OsmesaGlContext& operator=(const OsmesaGlContext&) = delete;

  [[nodiscard]] GlFunction get_proc_address(const char* name) const override {
    return osmesa_.get_proc_address(name);
  }
  [[nodiscard]] const char* name() const override { return "OSMesa"; }

 private:
  Osmesa osmesa_;
  OsmesaContext context_;
  std::unique_ptr<Pixel> pixel_;
};

}  // namespace

/// OSMesa has no debug contexts; messages come without one too, only fewer.
Result<std::unique_ptr<GlContext>> make_osmesa_context(bool /*debug*/) {
  const auto library = Library::open("libOSMesa.so.8");
  if (!library) return make_error("OSMesa: {}", library.error().message);
  Osmesa osmesa;
  library->find("OSMesaCreateContextAttribs", osmesa.create_context);
  library->find("OSMesaDestroyContext", osmesa.destroy_context);
  library->find("OSMesaMakeCurrent", osmesa.make_current);
  library->find("OSMesaGetProcAddress", osmesa.get_proc_address);
  if (osmesa.create_context == nullptr || osmesa.destroy_context == nullptr ||
      osmesa.make_current == nullptr || osmesa.get_proc_address == nullptr)
    return Error{"OSMesa: libOSMesa.so.8 is incomplete"};

  const std::array<int, 9> attributes{kOsmesaFormat,
                                      GL_RGBA,
                                      kOsmesaProfile,
                                      kOsmesaCoreProfile,
                                      kOsmesaMajor,
                                      4,
                                      kOsmesaMinor,
                                      5,
                                      0};
  OsmesaContext context = osmesa.create_context(attributes.data(), nullptr);
  if (context == nullptr) return Error{"OSMesa: no OpenGL 4.5 core context"};
  auto pixel = std::make_unique<Pixel>();
  if (osmesa.make_current(context, pixel->data(), GL_UNSIGNED_BYTE, 1, 1) != GL_TRUE) {
    osmesa.destroy_context(context);
    return Error{"OSMesa: its context can't be made current"};
  }
  return std::unique_ptr<GlContext>(
      std::make_unique<OsmesaGlContext>(osmesa, context, std::move(pixel)));
}

}  // namespace relief
