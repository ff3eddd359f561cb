// Images without what faces away from the eye: as if it were drawn, or it is drawn.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

#include "common/transform.h"
#include "tests/renderer/images.h"

namespace relief {
namespace {

using test::must_render;
using test::small_image;
using test::values;

struct CulledMethod {
  std::string_view engine;
  Primitive primitive;
  const char* name;
};

constexpr CulledMethod kMethods[] = {{"onepass", Primitive::Cell, "cell"},
                                     {"onepass", Primitive::Quad, "quad"},
                                     {"onepass", Primitive::Sprite, "sprite"},
                                     {"multipass", Primitive::Quad, "multipass quad"},
                                     {"multipass", Primitive::Sprite, "multipass sprite"}};

PatchModel closed_sphere() {
  PatchModel model = test::sphere_model({.spacing = 0.05, .patches_per_side = 2, .bumps = 0.05});
  model.is_closed = true;
  return model;
}

RenderSettings settings_of(const PatchModel& model, const CulledMethod& method) {
  RenderSettings settings = small_image(model);
  settings.engine = method.engine;
  settings.primitive = method.primitive;
  settings.outputs.depth = true;
  return settings;
}

RenderResult with(RenderSettings settings, CullMode cull, const PatchModel& model) {
  settings.cull = cull;
  return must_render(model, settings);
}

/// To the bit, so that NaN is the same as itself: `multipass` has it where a section cuts discs.
bool same_image(const RenderResult& a, const RenderResult& b) {
  for (const Channel& channel : a.image.channels) {
    const std::vector<float>& other = values(b.image, channel.name.c_str());
    if (channel.values.size() != other.size() ||
        std::memcmp(channel.values.data(), other.data(), other.size() * sizeof(float)) != 0)
      return false;
  }
  return a.covered_pixels > 0;
}

/// Whether the images differ, and by no more than a share of the pixels of a rim: back sides show
/// at silhouettes, by parts of a sample, which is a pixel here. `b` covers nothing else than `a`.
void expect_same_but_for_rims(const RenderResult& a, const RenderResult& b, const char* name) {
  const std::vector<float>& depth = values(a.image, "Z");
  const std::vector<float>& other = values(b.image, "Z");
  std::size_t uncovered = 0;
  std::size_t deeper = 0;
  for (std::size_t k = 0; k < depth.size(); ++k) {
    if (!std::isfinite(other[k])) {
      uncovered += std::isfinite(depth[k]) ? 1 : 0;
      continue;
    }
    ASSERT_TRUE(std::isfinite(depth[k])) << name;
    // The far side would be deeper by a radius or so.
    deeper += std::abs(other[k] - depth[k]) > 0.3F ? 1 : 0;
  }
  // A rim of 82 pixels' diameter has about 260.
  EXPECT_LE(uncovered, 40U) << name;
  EXPECT_EQ(deeper, 0U) << name;
  EXPECT_GT(b.covered_pixels, 4000U) << name;
}

TEST(CullMode, OfAClosedBodyOnlyTheFrontIsSeen) {
  const PatchModel model = closed_sphere();
  for (const CulledMethod& method : kMethods) {
    for (const bool orthographic : {false, true}) {
      RenderSettings settings = settings_of(model, method);
      if (orthographic) settings.camera.orthographic_height = 2.4;
      const RenderResult both = with(settings, CullMode::None, model);
      const RenderResult front = with(settings, CullMode::Back, model);
      expect_same_but_for_rims(both, front, method.name);
      EXPECT_LT(*front.fragments, *both.fragments) << method.name;
      EXPECT_TRUE(same_image(with(settings, CullMode::Auto, model), front)) << method.name;
    }
  }
}

TEST(CullMode, IsSafeForCellsOfPatchesThatMeet) {
  for (const bool meet : {true, false}) {
    PatchModel model = closed_sphere();
    if (meet) model.joined = {{0, static_cast<std::uint32_t>(model.patches.size()), true}};
    for (const CulledMethod& method : kMethods) {
      const RenderSettings settings = settings_of(model, method);
      const bool culls = meet && method.primitive == Primitive::Cell;
      EXPECT_TRUE(same_image(with(settings, CullMode::Safe, model),
                             with(settings, culls ? CullMode::Back : CullMode::None, model)))
          << method.name << (meet ? ", patches meet" : ", patches overlap");
    }
  }
}

TEST(CullMode, OfWhatIsNotKnownToBeClosedBothAreSeen) {
  PatchModel model = closed_sphere();
  model.is_closed = false;
  for (const CulledMethod& method : kMethods) {
    const RenderSettings settings = settings_of(model, method);
    EXPECT_TRUE(
        same_image(with(settings, CullMode::Auto, model), with(settings, CullMode::None, model)))
        << method.name;
  }
}

TEST(CullMode, AFieldSeenFromBehindHasNoFront) {
  const PatchModel model =
      test::height_field(30, [](double x, double y) { return 0.2 * std::sin(0.4 * x + 0.3 * y); });
  for (const CulledMethod& method : kMethods) {
    for (const bool orthographic : {false, true}) {
      RenderSettings settings = settings_of(model, method);
      settings.camera = {{3.0, 2.0, -45.0}, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, 45.0};
      if (orthographic) settings.camera.orthographic_height = 40.0;
      EXPECT_EQ(with(settings, CullMode::Back, model).covered_pixels, 0U) << method.name;
      EXPECT_GT(with(settings, CullMode::Auto, model).covered_pixels, 1000U) << method.name;
      settings.camera.eye.z = 45.0;
      EXPECT_TRUE(
          same_image(with(settings, CullMode::Back, model), with(settings, CullMode::None, model)))
          << method.name;
    }
  }
}

TEST(CullMode, FromWithinOrCutOpenABodyHasBoth) {
  const PatchModel model = closed_sphere();
  for (const CulledMethod& method : kMethods) {
    RenderSettings settings = settings_of(model, method);
    settings.camera = {{0.1, 0.0, 0.2}, {1.0, 0.2, 0.0}, {0.0, 1.0, 0.0}, 60.0};
    const RenderResult within = with(settings, CullMode::Auto, model);
    EXPECT_EQ(within.covered_pixels, std::uint64_t{settings.width} * settings.height)
        << method.name;
    EXPECT_EQ(with(settings, CullMode::Back, model).covered_pixels, 0U) << method.name;
    // A section: the plane through the eye goes through the middle.
    settings = settings_of(model, method);
    settings.camera.eye = {0.0, 0.0, 0.0};
    settings.camera.target = {0.0, 0.0, -1.0};
    settings.camera.orthographic_height = 2.4;
    const RenderResult cut = with(settings, CullMode::Auto, model);
    EXPECT_TRUE(same_image(cut, with(settings, CullMode::None, model))) << method.name;
    EXPECT_GT(cut.covered_pixels, 4000U) << method.name;
  }
}

TEST(CullMode, OfSemiTransparentBodiesBothAreSeen) {
  const PatchModel model = closed_sphere();
  RenderSettings settings = settings_of(model, kMethods[0]);
  settings.constants.opacity = 0.5F;
  const RenderResult both = with(settings, CullMode::None, model);
  EXPECT_TRUE(same_image(with(settings, CullMode::Auto, model), both));
  EXPECT_FALSE(same_image(with(settings, CullMode::Back, model), both));
}

/// A closed sphere, an open one and a mirrored one beside each other; each is where it should be.
TEST(CullMode, EachModelHasItsOwn) {
  const PatchModel sphere = closed_sphere();
  const PatchModel extent = without_patches(sphere);
  PatchModel open = extent;
  open.is_closed = false;
  const auto count = static_cast<std::uint32_t>(sphere.patches.size());
  PatchModel scene;
  scene.patches = sphere.patches;
  const glm::dmat3 turn = rotation_about({1.0, 2.0, -0.5}, 77.0);
  ASSERT_TRUE(add_instance(scene, {0, count, {{-2.2, 0.0, 0.0}, turn, 1.0}, 0}, extent));
  ASSERT_TRUE(add_instance(scene, {0, count, {{0.0, 0.0, 0.0}, turn, 1.0}, 0}, open));
  glm::dmat3 mirror = turn;
  mirror[0] = -mirror[0];
  ASSERT_TRUE(add_instance(scene, {0, count, {{2.2, 0.0, 0.0}, mirror, 1.0}, 0}, extent));
  for (const CulledMethod& method : kMethods) {
    RenderSettings settings = settings_of(scene, method);
    settings.width = 240;
    settings.camera = orbit_camera({0.0, 0.0, 0.0}, 2.0, {10.0, 5.0}, 45.0, 2.5);
    settings.pixels_per_sample = 0.0;
    const RenderResult both = with(settings, CullMode::None, scene);
    const RenderResult some = with(settings, CullMode::Auto, scene);
    expect_same_but_for_rims(both, some, method.name);
    // One of three: a third of the splats that face away are saved, a sixth of all.
    EXPECT_LT(*some.fragments, *both.fragments) << method.name;
    settings.cull = CullMode::Back;
    const RenderResult front = must_render(scene, settings);
    expect_same_but_for_rims(both, front, method.name);
    EXPECT_LT(*front.fragments, *some.fragments) << method.name;
  }
}

TEST(CullMode, AreExplained) {
  const PatchModel model = closed_sphere();
  for (const CulledMethod& method : kMethods) {
    RenderSettings settings = settings_of(model, method);
    settings.explain = true;
    for (const CullMode cull : {CullMode::None, CullMode::Auto}) {
      const RenderResult result = with(settings, cull, model);
      ASSERT_TRUE(result.explanation);
      const bool sprites = method.primitive == Primitive::Sprite;
      const std::vector<std::string>& features = result.explanation->features;
      const bool named = std::find(features.begin(), features.end(), "front") != features.end();
      const auto& draws = result.explanation->draws;
      const bool culled = std::any_of(draws.begin(), draws.end(),
                                      [](const auto& draw) { return draw.front_alone; });
      EXPECT_EQ(named, cull == CullMode::Auto && sprites) << method.name;
      EXPECT_EQ(culled, cull == CullMode::Auto && !sprites) << method.name;
    }
  }
}

}  // namespace
}  // namespace relief
