// Environments stand as the model does, and can be turned.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <string>
#include <vector>

#include "common/image/srgb.h"
#include "common/transform.h"
#include "renderer/shading/environment/standing_cube.h"
#include "tests/renderer/images.h"
#include "tests/renderer/shading/environment_file.h"
#include "tests/renderer/view/orthographic.h"

namespace relief {
namespace {

using test::by;
using test::EngineMethod;
using test::must_render;
using test::values;

glm::dvec3 in_environment(const Stance& stance, double degrees, glm::dvec3 direction) {
  RenderSettings settings;
  settings.environment_stance = stance;
  settings.environment_rotation_degrees = degrees;
  return environment_from_world(settings) * direction;
}

TEST(StandingCube, OfTheUsualStanceIsNotTurnedAtAll) {
  EXPECT_EQ(environment_from_world(RenderSettings()), glm::dmat3(1.0));
}

TEST(StandingCube, HasItsSkyAboveAndItsMiddleBehindTheModel) {
  EXPECT_EQ(in_environment(kZUp, 0.0, {0, 0, 1}), glm::dvec3(0, 1, 0));   // up
  EXPECT_EQ(in_environment(kZUp, 0.0, {0, 1, 0}), glm::dvec3(0, 0, -1));  // north
  EXPECT_EQ(in_environment(kZUp, 0.0, {1, 0, 0}), glm::dvec3(1, 0, 0));   // east
}

TEST(StandingCube, BringsToTheRightWhatWasInFront) {
  // To double precision: a cosine of 90 degrees is not 0.
  EXPECT_LT(glm::distance(in_environment({}, 90.0, {1, 0, 0}), {0, 0, 1}), 1e-15);
  EXPECT_LT(glm::distance(in_environment(kZUp, 90.0, {1, 0, 0}), {0, 0, 1}), 1e-15);
  EXPECT_LT(glm::distance(in_environment(kZUp, 90.0, {0, 0, 1}), {0, 1, 0}), 1e-15);
}

/// An engine each: how a surface is found has nothing to do with it.
constexpr EngineMethod kOneMethodEach[] = {
    {"onepass", Primitive::Cell, Interpolation::Corrected, "onepass"},
    {"multipass", Primitive::Quad, Interpolation::Corrected, "multipass"},
    {"surfel", Primitive::Cell, Interpolation::Corrected, "surfel"},
    {"ewa", Primitive::Cell, Interpolation::Corrected, "ewa"},
    {"raytrace", Primitive::Cell, Interpolation::Corrected, "raytrace"}};

/// A bumpy ball in an environment.
struct Scene {
  PatchModel model;
  RenderSettings settings;
};

/// Turns model and camera, but not the environment.
Scene turned(Scene scene, const glm::dmat3& rotation) {
  EXPECT_TRUE(transform_model(scene.model, {glm::dvec3(0.0), rotation, 1.0}));
  Camera& camera = scene.settings.camera;
  for (glm::dvec3* const v : {&camera.eye, &camera.target, &camera.up}) *v = rotation * *v;
  return scene;
}

/// The share of pixels that differ by more than two steps of 8 bits.
double share_of_different(const Image& a, const Image& b) {
  std::size_t count = 0;
  const std::size_t pixels = values(a, "R").size();
  for (std::size_t k = 0; k < pixels; ++k) {
    int largest = 0;
    for (const char* const name : {"R", "G", "B"}) {
      const int of_a = srgb8_from_linear(values(a, name)[k]);
      largest = std::max(largest, std::abs(of_a - srgb8_from_linear(values(b, name)[k])));
    }
    if (largest > 2) ++count;
  }
  return static_cast<double>(count) / static_cast<double>(pixels);
}

// A surface, its camera and its environment that are turned together give the same picture: what is
// reflected, refracted, scattered, and seen behind the surface.
TEST(StandingEnvironment, TurnsWithTheModelInEveryEngine) {
  const test::SmoothEnvironment environment;
  test::SphereShape shape;
  shape.spacing = 0.15;
  shape.bumps = 0.05;
  Scene before{test::sphere_model(shape), {}};
  before.settings = test::small_image(before.model, {25.0, 20.0}, 48);
  before.settings.environment = environment.path();
  const glm::dmat3 upright = rotation_about({1, 0, 0}, 90.0);
  const glm::dmat3 aside = rotation_about({0, 1, 0}, 40.0);
  for (const EngineMethod& method : kOneMethodEach) {
    for (const Material material : {Material::Lit, Material::Mirror, Material::Glass}) {
      const std::string what =
          std::string(method.name) + " " + std::string(name_of(kMaterials, material));
      Scene scene{before.model, by(method, before.settings)};
      scene.settings.background = glm::vec3(0.0F);
      scene.settings.material = material;
      scene.settings.lights.from_environment = material == Material::Lit;
      if (material == Material::Lit) scene.settings.constants.roughness = shared::kLitRoughness;
      scene.settings.lights.ambient = glm::vec3(0.0F);
      const Image first = must_render(scene.model, scene.settings).image;
      Scene standing = turned(scene, upright * aside);
      // Most of the picture would be another one.
      EXPECT_GT(share_of_different(first, must_render(standing.model, standing.settings).image),
                0.3)
          << what;
      standing.settings.environment_stance = kZUp;
      standing.settings.environment_rotation_degrees = 40.0;
      // A contour's pixels may be another patch's: rounding decides.
      EXPECT_LT(share_of_different(first, must_render(standing.model, standing.settings).image),
                0.01)
          << what;
    }
  }
}

}  // namespace
}  // namespace relief
