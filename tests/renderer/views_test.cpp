// Several views of a model, and models that were moved or put together.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "common/transform.h"
#include "shaders/include/shared.h"
#include "tests/renderer/images.h"

namespace relief {
namespace {

using test::must_render;
using test::small_image;
using test::values;

PatchModel bumpy_sphere(bool coloured) {
  test::SphereShape shape;
  shape.bumps = 0.1;
  shape.spacing = 0.08;
  shape.coloured = coloured;
  return test::sphere_model(shape);
}

void expect_same(const Image& a, const Image& b) {
  ASSERT_EQ(a.channels.size(), b.channels.size());
  for (std::size_t c = 0; c < a.channels.size(); ++c) {
    EXPECT_EQ(a.channels[c].name, b.channels[c].name);
    EXPECT_EQ(a.channels[c].values, b.channels[c].values) << a.channels[c].name;
  }
}

TEST(Views, DoNotAffectEachOther) {
  const PatchModel model = bumpy_sphere(true);
  std::vector<RenderSettings> views;
  for (const Material material : {Material::Unlit, Material::Mirror, Material::Lit}) {
    for (const test::Method& method : test::all_methods()) {
      const double turn = 40.0 * static_cast<double>(views.size());
      RenderSettings settings =
          small_image(model, {turn, 15.0, 1.3}, 48 + static_cast<std::uint32_t>(views.size()));
      settings.material = material;
      settings.primitive = method.primitive;
      settings.interpolation = method.interpolation;
      settings.outputs = views.size() % 2 == 0 ? test::all_outputs() : Outputs{};
      if (views.size() % 3 == 0) settings.background.reset();
      views.push_back(settings);
    }
  }
  Progress silent;
  std::vector<std::size_t> order;
  std::vector<RenderResult> results;
  const Status drawn = render_views(
      RenderModel::of(model), views,
      [&](std::size_t view, RenderResult result) {
        order.push_back(view);
        results.push_back(std::move(result));
        return Status();
      },
      silent);
  EXPECT_TRUE(drawn);
  ASSERT_EQ(order.size(), views.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    EXPECT_EQ(order[i], i);
    const RenderResult alone = must_render(model, views[i]);
    expect_same(results[i].image, alone.image);
    EXPECT_EQ(results[i].covered_pixels, alone.covered_pixels);
    EXPECT_EQ(results[i].fragments, alone.fragments);
  }
}

TEST(Views, EachFindsTheDataItReads) {
  // Unlit reads colours and no normals, a mirror normals and no colours.
  const PatchModel model = bumpy_sphere(true);
  for (const bool mirror_first : {false, true}) {
    std::vector<RenderSettings> views(2, small_image(model));
    views[0].material = mirror_first ? Material::Mirror : Material::Unlit;
    views[1].material = mirror_first ? Material::Unlit : Material::Mirror;
    Progress silent;
    std::vector<RenderResult> results;
    ASSERT_TRUE(render_views(
        RenderModel::of(model), views,
        [&results](std::size_t, RenderResult result) {
          results.push_back(std::move(result));
          return Status();
        },
        silent));
    for (std::size_t i = 0; i < views.size(); ++i)
      expect_same(results[i].image, must_render(model, views[i]).image);
  }
}

TEST(Views, ErrorsOfTheSinkEndTheRendering) {
  const PatchModel model = bumpy_sphere(false);
  const std::vector<RenderSettings> views(3, small_image(model));
  Progress silent;
  std::size_t taken = 0;
  const Status drawn = render_views(
      RenderModel::of(model), views,
      [&](std::size_t, const RenderResult&) {
        ++taken;
        return taken < 2 ? Status() : Status(Error{"the disk is full"});
      },
      silent);
  ASSERT_FALSE(drawn);
  EXPECT_EQ(drawn.error().message, "the disk is full");
  EXPECT_EQ(taken, 2U);
}

/// Counts units, and is cancelled once `patience` of them are done.
class Impatient final : public Progress {
 public:
  explicit Impatient(std::uint64_t patience) : patience_(patience) {}
  void begin_stage(std::string_view /*name*/, std::uint64_t units) override { promised += units; }
  void advance(std::uint64_t units) override { done += units; }
  [[nodiscard]] bool cancelled() const override { return done >= patience_; }
  std::uint64_t promised = 0;
  std::uint64_t done = 0;

 private:
  std::uint64_t patience_;
};

TEST(Views, ReportProgressAndCanBeCancelled) {
  const PatchModel model = bumpy_sphere(false);
  const std::vector<RenderSettings> views(3, small_image(model));
  std::size_t taken = 0;
  const ImageSink sink = [&taken](std::size_t, const RenderResult&) {
    ++taken;
    return Status();
  };
  Impatient patient(4);
  EXPECT_TRUE(render_views(RenderModel::of(model), views, sink, patient));
  EXPECT_EQ(patient.promised, 3U);
  EXPECT_EQ(patient.done, 3U);
  taken = 0;
  Impatient impatient(2);
  EXPECT_FALSE(render_views(RenderModel::of(model), views, sink, impatient));
  EXPECT_EQ(taken, 2U);
}

TEST(MovedModels, TwiceAsLargeFromTwiceAsFarIsTheSameImage) {
  const PatchModel model = bumpy_sphere(true);
  PatchModel large = model;
  ASSERT_TRUE(transform_model(large, {{}, glm::dmat3(1.0), 2.0}));
  for (const test::Method& method : test::all_methods()) {
    RenderSettings settings = small_image(model, {20.0, 15.0, 1.3});
    settings.primitive = method.primitive;
    settings.interpolation = method.interpolation;
    settings.outputs = test::all_outputs();
    const RenderResult small = must_render(model, settings);
    settings.camera.eye *= 2.0;
    settings.camera.target *= 2.0;
    RenderResult twice = must_render(large, settings);
    // A factor of two rounds nothing: exact, with depths doubled.
    for (Channel& channel : twice.image.channels) {
      if (channel.name != "Z") continue;
      for (float& depth : channel.values) depth *= 0.5F;
    }
    expect_same(small.image, twice.image);
  }
}

TEST(MovedModels, AMovedModelIsTheModelSeenByACameraMovedBack) {
  const PatchModel model = bumpy_sphere(true);
  const Transform transform{{3.0, -70.0, 11.0}, rotation_about({1.0, 2.0, -0.5}, 77.0), 1.7};
  PatchModel moved = model;
  ASSERT_TRUE(transform_model(moved, transform));
  const auto there = [&transform](glm::dvec3 p) {
    return transform.translation + transform.scale * (transform.rotation * p);
  };
  for (const test::Method& method : test::all_methods()) {
    RenderSettings settings = small_image(model, {20.0, 15.0});
    settings.primitive = method.primitive;
    settings.interpolation = method.interpolation;
    settings.outputs = test::all_outputs();
    const RenderResult one = must_render(model, settings);
    settings.camera.eye = there(settings.camera.eye);
    settings.camera.target = there(settings.camera.target);
    settings.camera.up = transform.rotation * settings.camera.up;
    const RenderResult other = must_render(moved, settings);
    // Single precision rounds the turned axes otherwise: ties between splats and at the rim may
    // fall the other way (measured: one of 6,000 pixels, in one of the four).
    EXPECT_LE(test::count_different(one.image, other.image, 1), 4U) << method.name;
    std::size_t wrong = 0;
    for (std::size_t k = 0; k < values(one.image, "Z").size(); ++k) {
      const auto normal = [k](const RenderResult& r) {
        return glm::dvec3(values(r.image, "N.X")[k], values(r.image, "N.Y")[k],
                          values(r.image, "N.Z")[k]);
      };
      if (values(one.image, "patch")[k] != values(other.image, "patch")[k]) {
        ++wrong;
        continue;
      }
      if (values(one.image, "patch")[k] == 0.0F) continue;
      const double depth = transform.scale * values(one.image, "Z")[k];
      // Depths are single precision (6e-8) after a few dozen operations; the normal's target holds
      // half floats (5e-4). The surface is seen at up to 75 degrees.
      const double aside = 4.0 * test::rasteriser_rounding(settings, other, depth);
      const bool same = std::abs(values(other.image, "Z")[k] - depth) < 1e-5 * depth + aside &&
                        glm::distance(transform.rotation * normal(one), normal(other)) < 2e-3;
      wrong += same ? 0 : 1;
    }
    EXPECT_LE(wrong, 4U) << method.name;
  }
}

TEST(MovedModels, OrbitsFollowTheModel) {
  const PatchModel model = bumpy_sphere(false);
  PatchModel moved = model;
  ASSERT_TRUE(transform_model(moved, {{1e6, -2e6, 5.0}, glm::dmat3(1.0), 4.0}));
  const RenderResult one = must_render(model, small_image(model, {30.0, 20.0}));
  const RenderResult other = must_render(moved, small_image(moved, {30.0, 20.0}));
  // Doubles at 2e6 are 5e-10 apart: ties alone.
  EXPECT_LE(test::count_different(one.image, other.image, 1), 2U);
}

TEST(JoinedModels, AreSeenSideBySideWithIdsThatCountOn) {
  PatchModel both = bumpy_sphere(true);
  const std::size_t first = both.patches.size();
  PatchModel grey = bumpy_sphere(false);
  ASSERT_TRUE(transform_model(grey, {{3.0, 0.0, 0.0}, glm::dmat3(1.0), 1.0}));
  append_model(both, grey);
  RenderSettings settings = small_image(both, {0.0, 0.0});
  settings.material = Material::Unlit;
  settings.outputs.patch_id = true;
  for (const test::Method& method : test::all_methods()) {
    settings.primitive = method.primitive;
    settings.interpolation = method.interpolation;
    const RenderResult result = must_render(both, settings);
    std::size_t coloured = 0;
    std::size_t neutral = 0;
    for (std::size_t k = 0; k < values(result.image, "patch").size(); ++k) {
      const auto patch = static_cast<std::size_t>(values(result.image, "patch")[k]);
      if (patch == 0) continue;
      const bool left = k % settings.width < settings.width / 2;
      EXPECT_EQ(patch <= first, left);
      (left ? coloured : neutral) += 1;
      if (left) continue;
      // The very grey of a model without colours.
      for (const char* channel : {"R", "G", "B"})
        ASSERT_EQ(values(result.image, channel)[k], shared::kNeutralGrey);
    }
    EXPECT_GT(coloured, 800U);
    EXPECT_GT(neutral, 800U);
  }
}

}  // namespace
}  // namespace relief
