// Rendering and comparing for the renderer's tests.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "common/image/srgb.h"
#include "renderer/render.h"
#include "tests/renderer/scenes.h"

namespace relief::test {

/// Settings for a small image of the whole model; debug contexts, and fragments are counted.
inline RenderSettings small_image(const PatchModel& model, Orbit orbit = {20.0, 15.0},
                                  std::uint32_t side = 96) {
  RenderSettings settings;
  settings.width = side + side / 4;
  settings.height = side;
  settings.camera = orbit_camera(0.5 * (model.bounds.min + model.bounds.max), model.bounding_radius,
                                 orbit, 45.0, 1.25);
  settings.count_fragments = true;
  settings.debug = true;
  return settings;
}

/// Straight down on a height field of `nodes` nodes a side, four pixels a cell.
inline RenderSettings from_above(const PatchModel& model, std::uint32_t nodes) {
  RenderSettings settings = small_image(model);
  settings.width = settings.height = 4 * nodes;
  settings.camera = {{0.0, 0.0, 0.5 * nodes / std::tan(std::acos(-1.0) / 8.0)},
                     {0.0, 0.0, 0.0},
                     {0.0, 1.0, 0.0},
                     45.0};
  return settings;
}

inline Outputs all_outputs() {
  return {true, true, true, true};
}

/// Renders; a failure fails the test and gives an empty image.
inline RenderResult must_render(const PatchModel& model, const RenderSettings& settings) {
  Progress silent;
  auto result = render(model, settings, silent);
  if (result) return *result;
  ADD_FAILURE() << result.error().message;
  return {};
}

/// Whether a GPU drew what an engine on OpenGL has drawn, not llvmpipe.
inline bool drawn_by_gpu(const RenderResult& result) {
  return !result.renderer.starts_with("llvmpipe");
}

/// How far beside its pixel's middle a fragment at `depth` may be interpolated, in the model's
/// units. GPUs round vertices to 1/256 pixel each way (GL_SUBPIXEL_BITS is 8 nearly everywhere) and
/// interpolate between those; llvmpipe interpolates between vertices as they were.
inline double rasteriser_rounding(const RenderSettings& settings, const RenderResult& result,
                                  double depth) {
  if (!drawn_by_gpu(result)) return 0.0;
  const double slope = std::tan(settings.camera.vertical_fov_degrees * std::acos(-1.0) / 360.0);
  return std::sqrt(2.0) / 512.0 * 2.0 * slope * depth / settings.height;
}

/// The most that a colour of 1 is off, or a fraction of it, by what draws it: GPUs may round to
/// half floats toward 0.
inline float colour_rounding(const RenderResult& result) {
  return drawn_by_gpu(result) ? 0x1p-11F : 0.0F;
}

inline const std::vector<float>& values(const Image& image, const char* name) {
  static const std::vector<float> nothing;
  const Channel* channel = image.find(name);
  EXPECT_NE(channel, nullptr) << name;
  return channel == nullptr ? nothing : channel->values;
}

/// The world ray through pixel (x, y), of unit depth.
inline glm::dvec3 pixel_ray(const RenderSettings& settings, std::size_t x, std::size_t y) {
  const double slope = std::tan(settings.camera.vertical_fov_degrees * std::acos(-1.0) / 360.0);
  const double aspect = static_cast<double>(settings.width) / settings.height;
  const double u = 2.0 * (static_cast<double>(x) + 0.5) / settings.width - 1.0;
  const double v = 1.0 - 2.0 * (static_cast<double>(y) + 0.5) / settings.height;
  return glm::transpose(view_rotation(settings.camera)) *
         glm::dvec3(u * slope * aspect, v * slope, -1.0);
}

/// Pixels whose 8-bit sRGB colour or coverage differs by more than `threshold` in any channel.
inline std::size_t count_different(const Image& a, const Image& b, int threshold) {
  std::size_t different = 0;
  const std::size_t pixels = std::size_t{a.width} * a.height;
  for (std::size_t k = 0; k < pixels; ++k) {
    bool differs = std::abs(values(a, "A")[k] - values(b, "A")[k]) > 0.5F;
    for (const char* channel : {"R", "G", "B"}) {
      const int x = srgb8_from_linear(values(a, channel)[k]);
      const int y = srgb8_from_linear(values(b, channel)[k]);
      differs = differs || std::abs(x - y) > threshold;
    }
    different += differs ? 1 : 0;
  }
  return different;
}

/// Every way to draw, for tests that run over all of them.
struct Method {
  Primitive primitive;
  Interpolation interpolation;
  const char* name;
};
inline const std::vector<Method>& all_methods() {
  static const std::vector<Method> methods{
      {Primitive::Quad, Interpolation::Direct, "quad_direct"},
      {Primitive::Quad, Interpolation::Corrected, "quad_corrected"},
      {Primitive::Sprite, Interpolation::Direct, "sprite_direct"},
      {Primitive::Sprite, Interpolation::Corrected, "sprite_corrected"},
      {Primitive::Cell, Interpolation::Direct, "cell_direct"},
      {Primitive::Cell, Interpolation::Corrected, "cell_corrected"}};
  return methods;
}

/// Of colour and alpha in dB, against a range of 1; infinite for equal images, 0 for images of
/// different sizes.
inline double psnr(const Image& a, const Image& b) {
  double sum = 0.0;
  double count = 0.0;
  for (const char* const name : {"R", "G", "B", "A"}) {
    const Channel* const x = a.find(name);
    const Channel* const y = b.find(name);
    if (x == nullptr || y == nullptr || x->values.size() != y->values.size()) return 0.0;
    for (std::size_t k = 0; k < x->values.size(); ++k) {
      const double off = static_cast<double>(x->values[k]) - static_cast<double>(y->values[k]);
      sum += off * off;
      count += 1.0;
    }
  }
  return sum > 0.0 ? 10.0 * std::log10(count / sum) : std::numeric_limits<double>::infinity();
}

}  // namespace relief::test
