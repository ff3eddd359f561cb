// What orthographic images may have beside a model: surroundings, reflections, opacity, samples,
// levels; and what the bench draws of them.
#include <gtest/gtest.h>

#include <unistd.h>
#include <string_view>

#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>

#include "common/image/image_io.h"
#include "renderer/bench/bench.h"
#include "renderer/frame/features.h"
#include "renderer/shading/environment/cube_map.h"
#include "tests/renderer/meshes.h"
#include "tests/renderer/view/orthographic.h"

namespace relief {
namespace {

using test::all_engine_methods;
using test::by;
using test::EngineMethod;
using test::must_render;
using test::values;

constexpr EngineMethod kCells{"onepass", Primitive::Cell, Interpolation::Corrected, "cells"};

glm::vec3 colour(const Image& image, std::size_t k) {
  return {values(image, "R")[k], values(image, "G")[k], values(image, "B")[k]};
}

/// A flat square of 12 nodes a side that fills the image, seen at a slant.
RenderSettings slanted_image(const PatchModel& model) {
  RenderSettings settings = test::small_image(model, {}, 48);
  settings.camera = {{9.0, 5.0, 20.0}, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}};
  settings.camera.orthographic_height = 6.0;
  return settings;
}

TEST(OrthographicSurroundings, AreTheSameInEveryPixel) {
  // All rays have one direction, and the environment is infinitely far away.
  const PatchModel model = test::height_field(2, [](double, double) { return 0.0; });
  RenderSettings settings = slanted_image(model);
  settings.camera.target = {9.0, 40.0, 3.0};  // looks past it
  const std::filesystem::path sky = std::filesystem::temp_directory_path() /
                                    ("relief-sky-" + std::to_string(::getpid()) + ".exr");
  Image panorama{64, 32, {}};
  for (const char* const name : {"R", "G", "B"}) {
    Channel channel{name, ChannelType::Float, {}};
    for (int k = 0; k < 64 * 32; ++k)
      channel.values.push_back(static_cast<float>(k % 64 + k / 64) / 96.0F);
    panorama.channels.push_back(std::move(channel));
  }
  ASSERT_TRUE(write_exr(sky, panorama));
  const auto surroundings = load_environment(sky);
  ASSERT_TRUE(surroundings);
  const glm::vec3 behind = look_up(*surroundings, test::forward(settings.camera));
  settings.environment = sky;
  for (const EngineMethod& method : all_engine_methods()) {
    RenderSettings drawn = by(method, settings);
    drawn.background = glm::vec3(0.0F);
    const Image image = must_render(model, drawn).image;
    for (std::size_t k = 0; k < values(image, "R").size(); ++k) {
      // Half floats.
      ASSERT_LT(glm::distance(colour(image, k), behind), 1e-3F) << method.name << " " << k;
    }
  }
  std::filesystem::remove(sky);
}

TEST(OrthographicMirrors, ThatAreFlatReflectOneDirection) {
  const PatchModel model = test::height_field(24, [](double, double) { return 0.0; });
  const auto cube = load_environment({});
  ASSERT_TRUE(cube);
  RenderSettings settings = slanted_image(model);
  settings.material = Material::Mirror;
  const glm::dvec3 ray = test::forward(settings.camera);
  const glm::vec3 expected = look_up(*cube, glm::dvec3(ray.x, ray.y, -ray.z));
  for (const EngineMethod& method : all_engine_methods()) {
    const RenderResult result = must_render(model, by(method, settings));
    ASSERT_EQ(result.covered_pixels, std::uint64_t{settings.width} * settings.height)
        << method.name;
    for (std::size_t k = 0; k < result.covered_pixels; ++k) {
      // Normals of 16 bits, and half floats, beside the lines of the grid that is reflected.
      ASSERT_LT(glm::distance(colour(result.image, k), expected), 0.01F) << method.name << " " << k;
    }
  }
}

TEST(OrthographicOpacity, OverlapsCountOnce) {
  test::SphereShape shape;
  shape.patches_per_side = 2;  // 24 patches, each two cells over its neighbours
  const PatchModel model = test::sphere_model(shape);
  for (const std::string_view engine : {"onepass", "raytrace"}) {
    EngineMethod method = kCells;
    method.engine = engine;
    RenderSettings settings = by(method, test::small_image(model));
    settings.camera.orthographic_height = 2.4;
    settings.constants.opacity = 0.5F;
    const Image image = must_render(model, settings).image;
    std::size_t inside = 0;
    for (std::size_t k = 0; k < values(image, "A").size(); ++k) {
      const glm::dvec3 start = test::pixel_start(settings, k % settings.width, k / settings.width);
      const glm::dvec3 ray = test::forward(settings.camera);
      // Toward the rim front and back come as near as patches that overlap.
      if (glm::length(start - glm::dot(start, ray) * ray) > 0.9) continue;
      ++inside;
      // Front and back, in half floats.
      ASSERT_NEAR(values(image, "A")[k], 0.75F, 3.0F / 2048.0F) << method.name << " " << k;
    }
    EXPECT_GT(inside, 4000U);
  }
}

TEST(OrthographicSamples, AreThePixelsOfALargerImage) {
  test::SphereShape shape;
  shape.bumps = 0.05;
  const PatchModel model = test::sphere_model(shape);
  for (const EngineMethod& method : all_engine_methods()) {
    if (method.engine == "ewa" || method.engine == "raytrace") continue;
    RenderSettings settings = by(method, test::small_image(model));
    settings.outputs = {};
    settings.camera.orthographic_height = 2.4;
    RenderSettings larger = settings;
    settings.samples = 4;
    larger.width *= 2;
    larger.height *= 2;
    const Image mean = must_render(model, settings).image;
    const Image fine = must_render(model, larger).image;
    std::size_t different = 0;
    for (std::size_t k = 0; k < values(mean, "A").size(); ++k) {
      const std::size_t corner = 2 * (k / mean.width) * fine.width + 2 * (k % mean.width);
      const auto sum = [&](const char* channel) {
        const std::vector<float>& all = values(fine, channel);
        return all[corner] + all[corner + 1] + all[corner + fine.width] +
               all[corner + fine.width + 1];
      };
      const bool same = std::abs(values(mean, "A")[k] - 0.25F * sum("A")) < 1e-3F &&
                        std::abs(values(mean, "G")[k] - 0.25F * sum("G")) < 1e-3F;
      different += same ? 0 : 1;
    }
    // The same positions through another matrix: ties may fall the other way.
    EXPECT_LE(different, values(mean, "A").size() / 500) << method.name;
  }
}

TEST(OrthographicFeature, IsOffInPerspectiveImages) {
  RenderSettings settings;
  const Features perspective = scene_features(settings, true);
  settings.camera.orthographic_height = 1.0;
  EXPECT_EQ(scene_features(settings, true), perspective | RELIEF_FEATURE_ORTHOGRAPHIC);
  EXPECT_FALSE(perspective.has(RELIEF_FEATURE_ORTHOGRAPHIC));
}

TEST(OrthographicBench, DrawsTheSameImage) {
  test::SphereShape shape;
  shape.spacing = 0.1;
  const PatchModel model = test::sphere_model(shape);
  const TriangleMesh mesh = test::sphere_mesh(64);
  RenderSettings settings = by(kCells, test::small_image(model));
  settings.camera.orthographic_height = 2.4;
  Progress silent;
  const auto report = bench({{{RenderModel::of(model), settings}}, &mesh, 0, 1, 0}, silent);
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_EQ(report->rows[0].covered_pixels, must_render(model, settings).covered_pixels);
  ASSERT_TRUE(report->mesh);
  RenderSettings traced = settings;
  traced.raytrace.samples = 1;
  const std::uint64_t truth = test::must_trace(mesh, traced).covered_pixels;
  // Vertices are snapped to 1/256 pixel: along a rim of 240 pixels one or two fall the other way.
  EXPECT_NEAR(static_cast<double>(report->mesh->covered_pixels), static_cast<double>(truth), 4.0);
}

}  // namespace
}  // namespace relief
