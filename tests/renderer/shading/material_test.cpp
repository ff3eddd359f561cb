// Every material and light in every engine, against the ray tracer, which shades by the same text;
// and materials of several patches in one image.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>
#include <utility>
#include <vector>

#include "common/transform.h"
#include "renderer/frame/features.h"
#include "shaders/include/shared.h"
#include "tests/renderer/images.h"
#include "tests/renderer/shading/environment_file.h"

namespace relief {
namespace {

using test::must_render;
using test::SmoothEnvironment;
using test::values;

/// What an image shows besides the model.
struct Look {
  const char* name;
  MaterialSettings material;
  std::vector<Light> lights;
};

MaterialSettings with(Material kind, const MaterialConstants& constants = {}) {
  return {kind, constants};
}

std::vector<Light> sixteen_lights() {
  std::vector<Light> lights;
  for (int i = 0; i < 16; ++i) {
    const double angle = 0.4 * i;
    const glm::dvec3 position(std::sin(angle), 0.1 * i - 0.8, std::cos(angle));
    const glm::vec3 colour(0.02F * static_cast<float>(i), 0.1F,
                           0.3F - 0.018F * static_cast<float>(i));
    if (i % 2 == 0) {
      lights.push_back({LightKind::Directional, glm::normalize(position), colour});
    } else {
      lights.push_back({LightKind::Point, 2.0 * position, 4.0F * colour});
    }
  }
  return lights;
}

const std::vector<Look>& all_looks() {
  static const std::vector<Look> looks{
      {"lit", with(Material::Lit), {}},
      {"one_light", with(Material::Lit), {{LightKind::Directional, {0, 1, 0}, {1, 0.5F, 0.2F}}}},
      {"point", with(Material::Lit), {{LightKind::Point, {1.5, 1.0, 1.0}, {2, 1, 0.5F}}}},
      {"sixteen_lights", with(Material::Lit), sixteen_lights()},
      {"mirror", with(Material::Mirror), {}},
      {"rough_mirror", with(Material::Mirror, {1.5F, {}, 0.4F}), {}},
      {"glass", with(Material::Glass), {}},
      {"tinted_glass", with(Material::Glass, {1.2F, {2.0F, 0.3F, 0.0F}, 0.0F}), {}},
      {"dense_glass", with(Material::Glass, {4.0F, {}, 0.0F}), {}}};
  return looks;
}

/// A smooth sphere, whose normals all engines have nearly alike.
PatchModel smooth_sphere() {
  test::SphereShape shape;
  shape.spacing = 0.04;
  return test::sphere_model(shape);
}

RenderSettings settings_of(const PatchModel& model, const Look& look) {
  RenderSettings settings = test::small_image(model, {25.0, 20.0});
  settings.material = look.material.kind;
  settings.constants = look.material.constants;
  settings.lights.list = look.lights;
  settings.background.reset();
  settings.raytrace.samples = 1;
  return settings;
}

/// Differences in 8-bit sRGB of the pixels that both cover, each a pixel's largest, ascending.
std::vector<int> differences(const Image& a, const Image& b) {
  std::vector<int> all;
  for (std::size_t k = 0; k < values(a, "A").size(); ++k) {
    if (values(a, "A")[k] < 1.0F || values(b, "A")[k] < 1.0F) continue;
    int largest = 0;
    for (const char* channel : {"R", "G", "B"}) {
      const int x = srgb8_from_linear(values(a, channel)[k]);
      largest = std::max(largest, std::abs(x - srgb8_from_linear(values(b, channel)[k])));
    }
    all.push_back(largest);
  }
  std::sort(all.begin(), all.end());
  return all;
}

/// Normals of the sphere are interpolated over half a cell by the one and a cell by the other, half
/// floats round by a part in 2048: a step or two of 8 bits. Near the silhouette, in a tenth of the
/// pixels, another splat in front turns the normal by as much as it changes over a pixel.
void expect_alike(const Image& seen, const Image& truth, const std::string& what) {
  const std::vector<int> all = differences(seen, truth);
  ASSERT_GT(all.size(), 3000U) << what;
  EXPECT_LE(all[all.size() / 2], 1) << what;
  EXPECT_LE(all[all.size() * 90 / 100], 3) << what;
}

class Looks : public testing::TestWithParam<Look> {};

TEST_P(Looks, AreTheRayTracersInEveryEngine) {
  const SmoothEnvironment environment;
  const PatchModel model = smooth_sphere();
  for (const double orthographic_height : {0.0, 2.4}) {
    RenderSettings settings = settings_of(model, GetParam());
    settings.camera.orthographic_height = orthographic_height;
    settings.environment = environment.path();
    settings.engine = "raytrace";
    const Image truth = must_render(model, settings).image;
    settings.engine = "onepass";
    for (const Primitive primitive : {Primitive::Quad, Primitive::Sprite, Primitive::Cell}) {
      settings.primitive = primitive;
      expect_alike(must_render(model, settings).image, truth,
                   "onepass " + std::string(name_of(kPrimitives, primitive)));
    }
    settings.engine = "multipass";
    settings.primitive = Primitive::Quad;
    expect_alike(must_render(model, settings).image, truth, "multipass");
  }
}

INSTANTIATE_TEST_SUITE_P(All, Looks, testing::ValuesIn(all_looks()),
                         [](const auto& look) { return std::string(look.param.name); });

/// Two spheres of two materials side by side.
PatchModel two_spheres() {
  test::SphereShape shape;
  shape.spacing = 0.06;
  shape.coloured = true;
  shape.centre = {-0.7, 0.0, 0.0};
  PatchModel model = test::sphere_model(shape);
  shape.centre = {0.7, 0.0, 0.3};
  PatchModel other = test::sphere_model(shape);
  for (Patch& patch : other.patches) patch.material = 1;
  append_model(model, std::move(other));
  return model;
}

class MixedMaterials : public testing::TestWithParam<std::string> {};

TEST_P(MixedMaterials, EachPatchMatchesAnImageOfItsMaterial) {
  const PatchModel model = two_spheres();
  const std::vector<MaterialSettings> all{
      with(Material::Unlit), with(Material::Lit), with(Material::Mirror),
      with(Material::Mirror, {1.5F, {}, 0.5F}), with(Material::Glass, {1.3F, {1, 0, 2}, 0.0F})};
  for (std::size_t i = 0; i + 1 < all.size(); ++i) {
    RenderSettings settings = settings_of(model, all_looks().front());
    settings.engine = GetParam();
    settings.outputs.patch_id = true;
    settings.materials = {all[i], all[i + 1]};
    const Image mixed = must_render(model, settings).image;
    settings.materials = {all[i], all[i]};
    const Image first = must_render(model, settings).image;
    settings.materials = {all[i + 1], all[i + 1]};
    const Image second = must_render(model, settings).image;
    const auto patches_of_first = static_cast<float>(model.patches.size()) / 2.0F;
    std::size_t different = 0;
    std::size_t covered = 0;
    for (std::size_t k = 0; k < values(mixed, "R").size(); ++k) {
      const float patch = values(mixed, "patch")[k];
      if (patch == 0.0F) continue;
      ++covered;
      const Image& alone = patch <= patches_of_first ? first : second;
      for (const char* channel : {"R", "G", "B"}) {
        // The rough environment of a mixed image may have another size; else the same lookups.
        if (std::abs(values(mixed, channel)[k] - values(alone, channel)[k]) > 2e-3F) {
          ++different;
          break;
        }
      }
    }
    EXPECT_GT(covered, 2000U);
    // Beside another material multipass sees the copy of the environment that both need.
    EXPECT_LE(different, covered / 100) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Engines, MixedMaterials,
                         testing::Values("onepass", "multipass", "raytrace", "ewa"),
                         [](const auto& engine) { return std::string(engine.param); });

TEST(MaterialFeatures, AreOnlyThoseInUse) {
  const auto features = [](std::vector<MaterialSettings> materials) {
    RenderSettings settings;
    settings.materials = std::move(materials);
    return scene_features(settings, true);
  };
  const MaterialSettings rough = with(Material::Mirror, {1.5F, {}, 0.5F});
  // A rough mirror alone is a mirror of another environment; two that are the same are one.
  EXPECT_EQ(features({rough, rough}), RELIEF_FEATURE_MIRROR);
  EXPECT_EQ(features({with(Material::Glass)}), RELIEF_FEATURE_GLASS);
  EXPECT_EQ(features({rough, with(Material::Unlit)}), RELIEF_FEATURE_MIXED | RELIEF_FEATURE_MIRROR |
                                                          RELIEF_FEATURE_ROUGH |
                                                          RELIEF_FEATURE_COLOURS);
  EXPECT_EQ(features({with(Material::Glass), with(Material::Glass, {2.0F, {}, 0.0F})}),
            RELIEF_FEATURE_MIXED | RELIEF_FEATURE_GLASS);
  // The camera's three lights, by number.
  EXPECT_EQ(features({with(Material::Lit)}),
            Features(RELIEF_FEATURE_LIT | RELIEF_FEATURE_COLOURS, 3));
}

TEST(MixedMaterialsOnMultipass, PatchIdsStayOutOfTheImage) {
  const PatchModel model = two_spheres();
  RenderSettings settings = settings_of(model, all_looks().front());
  settings.engine = "multipass";
  settings.materials = {with(Material::Lit), with(Material::Glass)};
  EXPECT_EQ(must_render(model, settings).image.find("patch"), nullptr);
}

}  // namespace
}  // namespace relief
