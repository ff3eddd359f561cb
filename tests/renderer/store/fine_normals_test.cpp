// Normal maps finer than the grid: exact, filtered, without neighbours' normals, at every level of
// detail; in all engines.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <string>

#include "common/octahedral.h"
#include "renderer/engines/onepass/features.h"
#include "renderer/frame/features.h"
#include "renderer/geometry/cells/levels.h"
#include "tests/renderer/images.h"
#include "tests/renderer/meshes.h"

namespace relief {
namespace {

using test::degrees_between;
using test::must_render;
using test::normal_of;
using test::values;

constexpr std::uint32_t kNormalNodes = 17;
constexpr std::uint32_t kNormalScale = 8;

/// The normal at a position of the square in cells from its corner, any length.
using Relief = std::function<glm::dvec3(double, double)>;

Patch patch_of_normals(const Patch& plain, const Relief& normal,
                       std::uint32_t scale = kNormalScale) {
  Patch patch = plain;
  const std::uint32_t side = scale * (patch.width - 1) + 1;
  patch.normals = {side, side, scale, {}};
  for (std::uint32_t j = 0; j < side; ++j) {
    for (std::uint32_t i = 0; i < side; ++i)
      patch.normals.texels.push_back(snorm16_from_unit(
          glm::vec3(glm::normalize(normal(double{1} * i / scale, double{1} * j / scale)))));
  }
  return patch;
}

/// A level square with a map of `scale` texels a cell.
PatchModel square_of_normals(const Relief& normal, std::uint32_t nodes = kNormalNodes,
                             std::uint32_t scale = kNormalScale) {
  PatchModel model = test::height_field(nodes, [](double, double) { return 0.0; });
  model.patches[0] = patch_of_normals(model.patches[0], normal, scale);
  return model;
}

/// Runs `look` over the images of all methods to draw a model, the rivals among them.
template <class Look>
void for_all_normal_methods(const PatchModel& model, RenderSettings settings, const Look& look) {
  settings.background.reset();
  settings.outputs = test::all_outputs();
  for (const test::Method& method : test::all_methods()) {
    settings.primitive = method.primitive;
    settings.interpolation = method.interpolation;
    look(must_render(model, settings), std::string(method.name));
  }
  settings.engine = "multipass";
  for (const Primitive primitive : {Primitive::Quad, Primitive::Sprite}) {
    settings.primitive = primitive;
    look(must_render(model, settings), std::string("multipass"));
  }
  settings.engine = "raytrace";
  settings.raytrace.samples = 1;
  look(must_render(model, settings), std::string("raytrace"));
}

/// Of the pixels that are covered, the largest angle to `normal(x, y)`, which are the world
/// coordinates seen there on the plane z = 0.
double largest_angle(const RenderResult& result, const RenderSettings& settings,
                     const std::function<glm::dvec3(double, double)>& normal, double reach) {
  double largest = 0.0;
  for (std::size_t y = 0; y < settings.height; ++y) {
    for (std::size_t x = 0; x < settings.width; ++x) {
      const std::size_t k = y * settings.width + x;
      if (values(result.image, "A")[k] < 1.0F) continue;
      const glm::dvec3 ray = test::pixel_ray(settings, x, y);
      const glm::dvec3 at = settings.camera.eye - settings.camera.eye.z / ray.z * ray;
      if (std::max(std::abs(at.x), std::abs(at.y)) > reach) continue;
      largest = std::max(
          largest, degrees_between(normal_of(result.image, k), glm::normalize(normal(at.x, at.y))));
    }
  }
  return largest;
}

TEST(FineNormals, AreAFeatureOfTheirOwn) {
  const auto up = [](double, double) { return glm::dvec3(0.0, 0.0, 1.0); };
  const ModelMaps fine(square_of_normals(up));
  const ModelMaps usual(square_of_normals(up, kNormalNodes, 1));
  RenderSettings settings;
  settings.material = Material::Lit;
  EXPECT_TRUE(scene_features(settings, fine).has(RELIEF_FEATURE_FINE_NORMALS));
  EXPECT_FALSE(scene_features(settings, usual).has(RELIEF_FEATURE_FINE_NORMALS));
  // Cells that are shaded later would not know what a pixel sees of the map.
  settings.primitive = Primitive::Cell;
  EXPECT_FALSE(onepass::features_of(settings, fine).has(RELIEF_FEATURE_VISIBILITY));
  EXPECT_TRUE(onepass::features_of(settings, usual).has(RELIEF_FEATURE_VISIBILITY));
  settings.material = Material::Unlit;  // which shows no normals
  EXPECT_FALSE(scene_features(settings, fine).has(RELIEF_FEATURE_FINE_NORMALS));
  settings.outputs.normal = true;
  EXPECT_TRUE(scene_features(settings, fine).has(RELIEF_FEATURE_FINE_NORMALS));
}

TEST(FineNormals, AConstantTiltIsReproduced) {
  const glm::dvec3 tilt = glm::normalize(glm::dvec3(0.3, -0.5, 0.8));
  const PatchModel model = square_of_normals([&](double, double) { return tilt; });
  // Seen askew and small: several mip levels and several lookups a pixel.
  for (const std::uint32_t side : {12U, 96U}) {
    RenderSettings settings = test::small_image(model, {20.0, 15.0}, side);
    settings.pixels_per_sample = 0.5;  // below 1 nothing is drawn from afar, which reads no map
    for_all_normal_methods(
        model, settings, [&](const RenderResult& result, const std::string& method) {
          // The map's 16 bits are 0.003 degrees; normals are half floats, half a step of which is
          // 2^-12: 0.014 degrees, and multipass sums them up in such.
          EXPECT_LT(largest_angle(
                        result, settings, [&](double, double) { return tilt; }, 100.0),
                    method == "multipass" ? 0.1 : 0.03)
              << method;
          EXPECT_GT(result.covered_pixels, 0U);
        });
  }
}

TEST(FineNormals, AreSharperThanTheGrid) {
  // Waves two cells long, which a normal a node would not see at all: 8 pixels each.
  const double pi = std::acos(-1.0);
  const auto waves = [pi](double x, double y) {
    return glm::dvec3(0.5 * std::cos(pi * x), 0.3 * std::sin(pi * y), 1.0);
  };
  const PatchModel model = square_of_normals(waves);
  const RenderSettings settings = test::from_above(model, kNormalNodes);
  const double half = 0.5 * (kNormalNodes - 1);
  for_all_normal_methods(
      model, settings, [&](const RenderResult& result, const std::string& method) {
        const double angle = largest_angle(
            result, settings, [&](double x, double y) { return waves(x + half, y + half); },
            half - 1.0);
        // What a pixel sees, a quarter of a cell, is level 1: means over h = 1/4 and bilinear
        // between them. That has a variance of h^2 / 12 + h^2 / 4 at most and takes from a wave of
        // wave number pi pi^2 / 2 of it, 10 % of a slope of 0.5: 2.3 degrees. A normal a node would
        // be 27 off.
        EXPECT_LT(angle, 2.4) << method;
        EXPECT_GT(angle, 0.0) << method;
      });
}

TEST(FineNormals, MinifiedTheyAreTheMeanDirection) {
  // Ridges of one texel, four of which and more are in a pixel: up, each side 37 degrees away.
  const PatchModel model = square_of_normals([](double x, double) {
    return glm::dvec3(static_cast<int>(std::lround(x * kNormalScale)) % 2 == 0 ? 0.6 : -0.6, 0.0,
                      0.8);
  });
  RenderSettings settings = test::from_above(model, kNormalNodes);
  settings.width = settings.height = 32;
  const double inside = 0.5 * (kNormalNodes - 1) - 2.0;
  for_all_normal_methods(
      model, settings, [&](const RenderResult& result, const std::string& method) {
        if (method == "raytrace") return;  // filters by rays
        const double angle = largest_angle(
            result, settings, [](double, double) { return glm::dvec3(0.0, 0.0, 1.0); }, inside);
        // Each level's mean has 16 bits.
        EXPECT_LT(angle, method == "multipass" ? 0.1 : 0.03) << method;
      });
}

TEST(FineNormals, NoPatchShowsItsNeighboursInTheAtlas) {
  // Nine squares that tilt to the one or the other side in turns, seen ever smaller.
  const glm::dvec3 one = glm::normalize(glm::dvec3(0.6, 0.0, 0.8));
  const glm::dvec3 other = glm::normalize(glm::dvec3(-0.6, 0.0, 0.8));
  PatchModel model = square_of_normals([&](double, double) { return one; });
  const Patch first = model.patches[0];
  for (int k = 1; k < 9; ++k) {
    Patch square =
        patch_of_normals(first, [&](double, double) { return k % 2 == 1 ? other : one; });
    square.origin += glm::dvec3(24.0 * (k % 3), 24.0 * (k / 3), 0.0);
    model.patches.push_back(square);
  }
  model.bounds.max += glm::dvec3(48.0, 48.0, 0.0);
  model.bounding_radius += 34.0;
  for (const std::uint32_t side : {13U, 31U, 67U, 160U}) {
    for_all_normal_methods(
        model, test::small_image(model, {10.0, 20.0}, side),
        [&](const RenderResult& result, const std::string& method) {
          if (method == "multipass") return;  // whose splats blend
          for (std::size_t k = 0; k < values(result.image, "A").size(); ++k) {
            if (values(result.image, "A")[k] < 1.0F) continue;
            const glm::dvec3 normal = normal_of(result.image, k);
            EXPECT_LT(std::min(degrees_between(normal, one), degrees_between(normal, other)), 0.03)
                << method;
          }
        });
  }
}

TEST(FineNormals, CoarseLevelsKeepTheFineMap) {
  const double pi = std::acos(-1.0);
  const auto waves = [pi](double x, double y) {
    return glm::dvec3(0.5 * std::cos(pi * x), 0.3 * std::sin(pi * y), 1.0);
  };
  const PatchModel model = square_of_normals(waves, 65);
  // Askew: a footprint as wide as high has one or two lookups, as rounding has it.
  RenderSettings settings = test::small_image(model, {25.0, 40.0}, 256);
  settings.background.reset();
  settings.outputs = test::all_outputs();
  settings.primitive = Primitive::Cell;
  settings.pixels_per_sample = 0.0;
  const RenderResult finest = must_render(model, settings);
  settings.pixels_per_sample = 40.0;  // levels of eight cells: four waves
  const RenderResult coarse = must_render(model, settings);
  View view = make_view(settings.camera, settings.width, settings.height, 0.01);
  view.pixels_per_sample = *settings.pixels_per_sample;
  ASSERT_EQ(choose_level(view, extent_of(model.patches[0])), 3U);
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t k = 0; k < values(finest.image, "A").size(); ++k) {
    if (values(finest.image, "A")[k] < 1.0F || values(coarse.image, "A")[k] < 1.0F) continue;
    const double angle = degrees_between(normal_of(finest.image, k), normal_of(coarse.image, k));
    sum += angle;
    ++count;
  }
  ASSERT_GT(count, 10'000U);
  // Places of the two are equal up to rounding. GPUs weigh texels, here up to 12 degrees apart, in
  // steps of 1/256 along two axes, in both images.
  EXPECT_LT(sum / static_cast<double>(count), test::drawn_by_gpu(finest) ? 0.08 : 0.05);
}

TEST(FineNormals, LitAndMirrorImagesAreThoseOfRaysToThePatch) {
  const double pi = std::acos(-1.0);
  const PatchModel model = square_of_normals([pi](double x, double y) {
    return glm::dvec3(0.4 * std::cos(0.5 * pi * x), 0.4 * std::sin(0.5 * pi * y), 1.0);
  });
  for (const Material material : {Material::Lit, Material::Mirror}) {
    RenderSettings settings = test::small_image(model, {20.0, 30.0});
    settings.material = material;
    settings.primitive = Primitive::Cell;
    settings.background.reset();
    const RenderResult drawn = must_render(model, settings);
    settings.engine = "raytrace";
    settings.raytrace.samples = 16;
    const RenderResult traced = must_render(model, settings);
    double squares = 0.0;
    std::size_t count = 0;
    for (std::size_t k = 0; k < values(drawn.image, "A").size(); ++k) {
      if (values(drawn.image, "A")[k] < 1.0F || values(traced.image, "A")[k] < 1.0F) continue;
      for (const char* channel : {"R", "G", "B"}) {
        const double a = srgb_from_linear(values(drawn.image, channel)[k]);
        const double b = srgb_from_linear(values(traced.image, channel)[k]);
        squares += (a - b) * (a - b);
        ++count;
      }
    }
    const double psnr = -10.0 * std::log10(squares / static_cast<double>(count));
    RecordProperty(material == Material::Lit ? "lit" : "mirror", std::to_string(psnr));
    EXPECT_GT(psnr, material == Material::Lit ? 40.0 : 24.0);
  }
}

}  // namespace
}  // namespace relief
