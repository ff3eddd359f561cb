// Models with several instances, from near and from afar.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>
#include <string_view>

#include "common/transform.h"
#include "tests/renderer/images.h"

namespace relief {
namespace {

using test::must_render;
using test::small_image;
using test::values;

/// Two spheres' patches, one of them bumpy and coloured, and five instances of them. They are
/// scaled by powers of two, which round nothing.
PatchModel placed_spheres() {
  PatchModel model = test::sphere_model({.spacing = 0.1, .bumps = 0.1, .coloured = true});
  const PatchModel first = without_patches(model);
  const PatchModel other = test::sphere_model({.radius = 0.5, .spacing = 0.1});
  const auto count = static_cast<std::uint32_t>(model.patches.size());
  const auto others = static_cast<std::uint32_t>(other.patches.size());
  model.patches.insert(model.patches.end(), other.patches.begin(), other.patches.end());
  PatchModel placed;
  placed.patches = std::move(model.patches);
  const glm::dmat3 turn = rotation_about({1.0, 2.0, -0.5}, 77.0);
  for (const auto& [x, scale, material] :
       {std::tuple{-2.0, 1.0, 0}, {0.5, 0.5, 1}, {2.5, 2.0, 0}}) {
    const Instance instance{
        0, count, {{x, 0.0, 0.3 * x}, turn, scale}, static_cast<std::uint8_t>(material)};
    EXPECT_TRUE(add_instance(placed, instance, first));
  }
  for (const double z : {1.5, -1.5}) {
    const Instance instance{count, others, {{0.0, 0.0, z}, glm::dmat3(1.0), 1.0}, 1};
    EXPECT_TRUE(add_instance(placed, instance, without_patches(other)));
  }
  return placed;
}

/// What lies where is the same to the bit. Maps of patches that are there twice lie elsewhere in
/// the atlas, which rounds lookups otherwise: colours and normals, half floats below 2, by two
/// steps.
void expect_same(const RenderResult& one, const RenderResult& other, const std::string& what) {
  for (const Channel& channel : one.image.channels) {
    const bool looked_up =
        channel.name[0] == 'N' || std::string("RGB").find(channel.name) != std::string::npos;
    const std::vector<float>& expected = values(other.image, channel.name.c_str());
    ASSERT_EQ(channel.values.size(), expected.size());
    for (std::size_t k = 0; k < expected.size(); ++k) {
      if (channel.values[k] == expected[k]) continue;
      ASSERT_TRUE(looked_up) << what << " " << channel.name;
      ASSERT_NEAR(channel.values[k], expected[k], 2.0 / 1024.0) << what << " " << channel.name;
    }
  }
}

RenderSettings two_materials(RenderSettings settings) {
  settings.materials = {{Material::Lit, {}}, {Material::Unlit, {}}};
  settings.outputs = test::all_outputs();
  return settings;
}

TEST(Instances, AreDrawnAsModelsOfTheirOwn) {
  const PatchModel placed = placed_spheres();
  const PatchModel baked = bake(placed);
  ASSERT_EQ(baked.patches.size(), 3U * 6U + 2U * 6U);
  for (const test::Method& method : test::all_methods()) {
    RenderSettings settings = two_materials(small_image(placed));
    settings.primitive = method.primitive;
    settings.interpolation = method.interpolation;
    settings.pixels_per_sample = 0.0;  // or baked models, which are one model, would be nearer
    const RenderResult one = must_render(placed, settings);
    const RenderResult other = must_render(baked, settings);
    EXPECT_GT(one.covered_pixels, 500U) << method.name;
    expect_same(one, other, method.name);
  }
}

TEST(Instances, AreDrawnSoByEveryEngine) {
  const PatchModel placed = placed_spheres();
  const PatchModel baked = bake(placed);
  for (const std::string_view engine : {"multipass", "ewa", "raytrace"}) {
    RenderSettings settings = two_materials(small_image(placed, {20.0, 15.0}, 48));
    settings.engine = engine;
    settings.primitive = Primitive::Quad;
    settings.raytrace.samples = 1;
    const RenderResult one = must_render(placed, settings);
    const RenderResult other = must_render(baked, settings);
    expect_same(one, other, std::string(engine));
  }
}

TEST(Instances, PatchIdsCountOnFromOneToTheNext) {
  const PatchModel placed = placed_spheres();
  RenderSettings settings = two_materials(small_image(placed));
  const RenderResult result = must_render(placed, settings);
  const std::vector<float>& ids = values(result.image, "patch");
  // The last instance begins after four others.
  EXPECT_GT(*std::max_element(ids.begin(), ids.end()), 3.0F * 6.0F + 6.0F);
  EXPECT_LE(*std::max_element(ids.begin(), ids.end()), 5.0F * 6.0F);
}

/// A sphere of radius 1 that is `pixels` wide in an image of 160 x 128.
struct ProxySphere {
  PatchModel model = test::sphere_model({.spacing = 0.02, .patches_per_side = 2, .coloured = true});
  RenderSettings settings;

  explicit ProxySphere(double pixels, bool orthographic) {
    settings = small_image(model, {20.0, 15.0}, 128);
    settings.outputs = test::all_outputs();
    settings.explain = true;
    settings.background = std::nullopt;
    const double slope = std::tan(settings.camera.vertical_fov_degrees * std::acos(-1.0) / 360.0);
    const double distance = 128.0 / (pixels * slope);
    settings.camera.eye = distance * glm::normalize(settings.camera.eye);
    settings.camera.target = glm::dvec3(0.0);
    if (orthographic) settings.camera.orthographic_height = 2.0 * distance * slope;
  }
};

bool draws_proxies(const RenderResult& result) {
  return result.explanation &&
         std::any_of(result.explanation->passes.begin(), result.explanation->passes.end(),
                     [](const auto& pass) { return pass == "proxies"; });
}

class Proxies : public testing::TestWithParam<bool> {};

/// What a pixel's middle sees: a line, whose direction is of unit depth.
struct Sight {
  glm::dvec3 start{0.0};
  glm::dvec3 along{0.0};
};

Sight sight_of(const RenderSettings& settings, std::size_t pixel) {
  const std::size_t x = pixel % settings.width;
  const std::size_t y = pixel / settings.width;
  const glm::dvec3 eye = settings.camera.eye;
  if (!settings.camera.is_orthographic()) return {eye, test::pixel_ray(settings, x, y)};
  const double size = settings.camera.orthographic_height / settings.height;
  const glm::dmat3 axes = glm::transpose(view_rotation(settings.camera));
  const double right = static_cast<double>(x) + 0.5 - 0.5 * settings.width;
  const double up = 0.5 * settings.height - static_cast<double>(y) - 0.5;
  return {eye + size * (right * axes[0] + up * axes[1]), -axes[2]};
}

TEST_P(Proxies, ASphereIsWhereItsFormulaSays) {
  const ProxySphere sphere(40.0, GetParam());
  const RenderResult result = must_render(sphere.model, sphere.settings);
  EXPECT_TRUE(draws_proxies(result));
  for (std::size_t k = 0; k < values(result.image, "A").size(); ++k) {
    const auto [start, along] = sight_of(sphere.settings, k);
    const double middle = -glm::dot(start, along) / glm::dot(along, along);
    const double away = glm::length(start + middle * along);
    const bool seen = values(result.image, "A")[k] > 0.5F;
    // A pixel is 1/20. Chords of two are 1/80 of a pixel within the sphere; planes that meet are as
    // much outside.
    if (std::abs(away - 1.0) > 0.2 / 20.0) {
      EXPECT_EQ(seen, away < 1.0) << away;
    }
    if (!seen || away > 0.85) continue;
    const double back = std::sqrt((1.0 - away * away) / glm::dot(along, along));
    const glm::dvec3 hit = start + (middle - back) * along;
    const glm::dvec3 normal(values(result.image, "N.X")[k], values(result.image, "N.Y")[k],
                            values(result.image, "N.Z")[k]);
    // Vertices are means over a pixel, and where one is in it is not known: that much of the
    // radius.
    EXPECT_LT(glm::distance(normal, hit), 0.05) << away;
    // Over its cosine at 0.85, which is a half, half of that.
    EXPECT_NEAR(values(result.image, "Z")[k], middle - back, 0.01) << away;
    const float patch = values(result.image, "patch")[k];
    EXPECT_TRUE(patch >= 1.0F && patch <= 24.0F) << patch;
  }
}

TEST_P(Proxies, ReportTheCoordinatesOfANearbySample) {
  const ProxySphere sphere(40.0, GetParam());
  const RenderResult result = must_render(sphere.model, sphere.settings);
  const RenderSettings& settings = sphere.settings;
  for (std::size_t k = 0; k < values(result.image, "patch").size(); ++k) {
    const auto id = static_cast<std::uint32_t>(values(result.image, "patch")[k]);
    if (id == 0) continue;
    const Patch& patch = sphere.model.patches[id - 1];
    const auto i = static_cast<std::uint32_t>(values(result.image, "UV.U")[k]);
    const auto j = static_cast<std::uint32_t>(values(result.image, "UV.V")[k]);
    ASSERT_LT(i, patch.width);
    ASSERT_LT(j, patch.height);
    const glm::dvec3 sample = position_of(patch, i, j);
    const glm::dvec3 normal(values(result.image, "N.X")[k], values(result.image, "N.Y")[k],
                            values(result.image, "N.Z")[k]);
    // A triangle tells one of its corners, at most two cubes of 0.1 and their diagonals away.
    EXPECT_LT(glm::distance(glm::normalize(normal), glm::normalize(sample)), 0.45);
    EXPECT_EQ(settings.width, result.image.width);
  }
}

INSTANTIATE_TEST_SUITE_P(Cameras, Proxies, testing::Bool(), [](const auto& tested) {
  return tested.param ? "orthographic" : "perspective";
});

TEST(Proxies, AreNotDrawnUpCloseOrWhenOff) {
  const ProxySphere near(68.0, false);
  EXPECT_FALSE(draws_proxies(must_render(near.model, near.settings)));
  for (const auto& change : std::vector<void (*)(RenderSettings&)>{
           [](RenderSettings& s) { s.pixels_per_sample = 0.0; },
           [](RenderSettings& s) { s.primitive = Primitive::Quad; },
           [](RenderSettings& s) { s.constants.opacity = 0.5F; }}) {
    ProxySphere far(40.0, false);
    EXPECT_TRUE(draws_proxies(must_render(far.model, far.settings)));
    change(far.settings);
    EXPECT_FALSE(draws_proxies(must_render(far.model, far.settings)));
  }
}

TEST(Proxies, LookAsCellsDo) {
  const ProxySphere far(48.0, false);
  RenderSettings cells = far.settings;
  cells.pixels_per_sample = 0.0;
  const RenderResult one = must_render(far.model, far.settings);
  const RenderResult other = must_render(far.model, cells);
  ASSERT_TRUE(draws_proxies(one));
  double squared = 0.0;
  std::size_t both = 0;
  for (std::size_t k = 0; k < values(one.image, "A").size(); ++k) {
    if (values(one.image, "A")[k] < 0.5F || values(other.image, "A")[k] < 0.5F) continue;
    ++both;
    for (const char* channel : {"R", "G", "B"}) {
      const double difference = srgb_from_linear(values(one.image, channel)[k]) -
                                srgb_from_linear(values(other.image, channel)[k]);
      squared += difference * difference / 3.0;
    }
  }
  ASSERT_GT(both, 1500U);
  // The sphere is smooth and its colours are: what is left is shading once a pixel but
  // not in its middle.
  EXPECT_GT(-10.0 * std::log10(squared / static_cast<double>(both)), 30.0);
}

}  // namespace
}  // namespace relief
