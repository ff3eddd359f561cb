// Semi-transparent materials: what covers what, and by how much.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string_view>

#include "renderer/append.h"
#include "tests/renderer/images.h"

namespace relief {
namespace {

using test::must_render;
using test::values;

// Half floats, three times rounded: each to 1 in 2048.
constexpr float kBlendRounding = 3.0F / 2048.0F;

MaterialSettings unlit(float opacity) {
  MaterialSettings material{Material::Unlit, {}};
  material.constants.opacity = opacity;
  return material;
}

/// A flat square of one grey (sRGB) at a height, in cells.
PatchModel sheet(double height, std::uint8_t grey, std::uint8_t material) {
  PatchModel model = test::height_field(12, [](double, double) { return 0.0; });
  Patch& patch = model.patches[0];
  patch.origin.z += height;
  patch.material = material;
  patch.colours = {patch.width, patch.height, 1, {}};
  patch.colours.texels.assign(patch.heights.size(), glm::u8vec3(grey));
  model.has_colours = true;
  model.bounds.min.z = model.bounds.max.z = height;
  return model;
}

/// White (1), black (0) and white again, from above; each is its own material.
PatchModel three_sheets() {
  PatchModel model = sheet(4.0, 255, 0);
  append_model(model, sheet(0.0, 0, 1));
  append_model(model, sheet(-4.0, 255, 2));
  return model;
}

RenderSettings from_above(const PatchModel& model) {
  RenderSettings settings = test::from_above(model, 12);
  settings.background = glm::vec3(0.25F);
  settings.outputs = test::all_outputs();
  return settings;
}

class Opacity : public testing::TestWithParam<std::string> {};

TEST_P(Opacity, LayersCoverWhatIsBehindThem) {
  const PatchModel model = three_sheets();
  RenderSettings settings = from_above(model);
  settings.engine = GetParam();
  const std::size_t middle = std::size_t{settings.height / 2} * settings.width + settings.width / 2;
  const struct {
    float top, between, below, expected;
  } cases[] = {
      {0.5F, 0.5F, 0.5F, 0.5F + 0.125F + 0.125F * 0.25F},  // light that comes through three halves
      {0.5F, 1.0F, 0.5F, 0.5F},                            // the black one hides the rest
      {0.25F, 0.0F, 1.0F, 1.0F},                           // what is not there covers nothing
      {0.0F, 0.5F, 0.0F, 0.125F},
  };
  for (const double orthographic_height : {0.0, 12.0}) {
    settings.camera.orthographic_height = orthographic_height;
    for (const auto& c : cases) {
      settings.materials = {unlit(c.top), unlit(c.between), unlit(c.below)};
      const Image image = must_render(model, settings).image;
      EXPECT_NEAR(values(image, "R")[middle], c.expected, kBlendRounding)
          << c.top << " " << c.between << " " << orthographic_height;
    }
  }
}

TEST_P(Opacity, BackgroundsShowThrough) {
  const PatchModel model = sheet(0.0, 255, 0);
  RenderSettings settings = from_above(model);
  settings.engine = GetParam();
  settings.camera.eye *= 2.0;  // so that the sheet fills half the image's width
  settings.background = std::nullopt;
  settings.material = Material::Unlit;
  settings.constants.opacity = 0.25F;
  const Image image = must_render(model, settings).image;
  const std::size_t middle = std::size_t{settings.height / 2} * settings.width + settings.width / 2;
  EXPECT_NEAR(values(image, "A")[middle], 0.25F, kBlendRounding);
  EXPECT_NEAR(values(image, "R")[middle], 0.25F, kBlendRounding);  // premultiplied
  EXPECT_EQ(values(image, "A")[0], 0.0F);
}

INSTANTIATE_TEST_SUITE_P(Engines, Opacity, testing::Values("onepass", "raytrace", "ewa"),
                         [](const auto& engine) { return std::string(engine.param); });

TEST(OpacityOfPatches, OverlapsCountOnce) {
  test::SphereShape shape;
  shape.patches_per_side = 2;  // 24 patches, each two cells over its neighbours
  const PatchModel model = test::sphere_model(shape);
  RenderSettings settings = test::small_image(model);
  settings.background = std::nullopt;
  settings.constants.opacity = 0.5F;
  settings.outputs = test::all_outputs();
  for (const std::string_view engine : {"onepass", "raytrace"}) {
    settings.engine = engine;
    settings.raytrace.samples = 1;
    const Image image = must_render(model, settings).image;
    std::size_t inside = 0;
    std::size_t other = 0;
    for (std::size_t y = 0; y < settings.height; ++y) {
      for (std::size_t x = 0; x < settings.width; ++x) {
        const glm::dvec3 ray = glm::normalize(test::pixel_ray(settings, x, y));
        // Toward the rim front and back come as near as patches that overlap.
        if (glm::length(glm::cross(settings.camera.eye, ray)) > 0.9) continue;
        ++inside;
        const float alpha = values(image, "A")[y * settings.width + x];
        other += std::abs(alpha - 0.75F) > kBlendRounding ? 1 : 0;
      }
    }
    EXPECT_GT(inside, 1500U);
    EXPECT_EQ(other, 0U) << engine;
  }
}

TEST(OpacityOfPatches, OutputsAreThoseOfTheFront) {
  const PatchModel model = three_sheets();
  RenderSettings settings = from_above(model);
  settings.materials = {unlit(0.5F), unlit(1.0F), unlit(0.5F)};
  const Image image = must_render(model, settings).image;
  settings.materials = {unlit(1.0F), unlit(1.0F), unlit(1.0F)};
  const Image opaque = must_render(model, settings).image;
  for (const char* channel : {"N.X", "N.Z", "Z", "patch", "UV.U"}) {
    const std::vector<float>& a = values(image, channel);
    const std::vector<float>& b = values(opaque, channel);
    for (std::size_t k = 0; k < a.size(); ++k) {
      // Places are noted to 1/8192 of a cell or finer where surfaces are shaded later.
      if (!std::isfinite(b[k])) continue;
      EXPECT_NEAR(a[k], b[k], 1.0F / 8192.0F) << channel << " " << k;
    }
  }
}

TEST(OpacityOfPatches, SplatsAreRefused) {
  const PatchModel model = sheet(0.0, 255, 0);
  Progress silent;
  RenderSettings settings = from_above(model);
  settings.constants.opacity = 0.5F;
  settings.primitive = Primitive::Quad;
  for (const std::string_view engine : {"onepass", "multipass"}) {
    settings.engine = engine;
    const auto result = render(model, settings, silent);
    ASSERT_FALSE(result);
    EXPECT_NE(result.error().message.find("opacity is below 1"), std::string::npos);
  }
}

TEST(OpacityOfPatches, IsOffInOpaqueImages) {
  const PatchModel model = three_sheets();
  RenderSettings settings = from_above(model);
  settings.explain = true;
  for (const float opacity : {1.0F, 0.5F}) {
    settings.materials = {unlit(opacity), unlit(1.0F), unlit(1.0F)};
    const auto explanation = must_render(model, settings).explanation;
    ASSERT_TRUE(explanation);
    const bool layers = std::any_of(explanation->textures.begin(), explanation->textures.end(),
                                    [](const auto& t) { return t.name == "layers"; });
    EXPECT_EQ(layers, opacity < 1.0F);
  }
}

}  // namespace
}  // namespace relief
