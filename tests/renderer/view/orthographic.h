// Orthographic images, for the tests of them.
#pragma once

#include <glm/geometric.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "tests/renderer/images.h"

namespace relief::test {

/// An engine and, of those on OpenGL, how it draws.
struct EngineMethod {
  std::string_view engine;
  Primitive primitive;
  Interpolation interpolation;
  const char* name;

  [[nodiscard]] bool is_cells() const {
    return engine == "onepass" && primitive == Primitive::Cell;
  }
};

inline const std::vector<EngineMethod>& all_engine_methods() {
  static const std::vector<EngineMethod> methods = [] {
    std::vector<EngineMethod> all;
    for (const Method& method : all_methods())
      all.push_back({"onepass", method.primitive, method.interpolation, method.name});
    const auto any = Interpolation::Corrected;
    all.push_back({"multipass", Primitive::Quad, any, "multipass_quad"});
    all.push_back({"multipass", Primitive::Sprite, any, "multipass_sprite"});
    all.push_back({"raytrace", Primitive::Cell, any, "raytrace"});
    all.push_back({"ewa", Primitive::Cell, any, "ewa"});
    return all;
  }();
  return methods;
}

/// The image by an engine: all outputs, transparent where nothing is, the finest level, a ray a
/// pixel.
inline RenderSettings by(const EngineMethod& method, RenderSettings settings) {
  settings.engine = method.engine;
  settings.primitive = method.primitive;
  settings.interpolation = method.interpolation;
  settings.outputs = all_outputs();
  settings.background.reset();
  settings.pixels_per_sample = 0.0;
  settings.raytrace.samples = 1;
  return settings;
}

/// World units a pixel of an orthographic image.
inline double pixel_size(const RenderSettings& settings) {
  return settings.camera.orthographic_height / settings.height;
}

/// The world direction of all rays, of length 1.
inline glm::dvec3 forward(const Camera& camera) {
  return glm::normalize(camera.target - camera.eye);
}

/// Where the ray through pixel (x, y) begins, world: in the plane through the eye.
inline glm::dvec3 pixel_start(const RenderSettings& settings, std::size_t x, std::size_t y) {
  const double u = static_cast<double>(x) + 0.5 - 0.5 * settings.width;
  const double v = 0.5 * settings.height - static_cast<double>(y) - 0.5;
  return settings.camera.eye + glm::transpose(view_rotation(settings.camera)) *
                                   (pixel_size(settings) * glm::dvec3(u, v, 0.0));
}

inline glm::dvec3 normal_at(const Image& image, std::size_t k) {
  return {values(image, "N.X")[k], values(image, "N.Y")[k], values(image, "N.Z")[k]};
}

inline std::string name_of_method(const testing::TestParamInfo<EngineMethod>& info) {
  return info.param.name;
}

}  // namespace relief::test
