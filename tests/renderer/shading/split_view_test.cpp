// The split view: each quarter of the image is what its material alone shows.
#include "renderer/engine_checks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <string>
#include <string_view>

#include "renderer/frame/features.h"
#include "renderer/view/uniforms.h"
#include "renderer/view/view.h"
#include "shaders/include/split_view.h"
#include "tests/renderer/images.h"

namespace relief {
namespace {

using test::must_render;
using test::values;

enum class Quarter { Lit, Mirror, Both, Samples, Line };

/// What a pixel shows, row 0 on top: a line is two pixels wide where the middle is between pixels,
/// one where it is a pixel's.
Quarter quarter_of(const Image& image, std::size_t k) {
  const double x = static_cast<double>(k % image.width) + 0.5 - 0.5 * image.width;
  const double y = 0.5 * image.height - (static_cast<double>(k / image.width) + 0.5);
  if (std::min(std::abs(x), std::abs(y)) < 0.75) return Quarter::Line;
  if (y > 0.0) return x < 0.0 ? Quarter::Lit : Quarter::Mirror;
  return x < 0.0 ? Quarter::Samples : Quarter::Both;
}

glm::vec3 split_colour(const Image& image, std::size_t k) {
  return {values(image, "R")[k], values(image, "G")[k], values(image, "B")[k]};
}

PatchModel split_bumpy_sphere() {
  test::SphereShape shape;
  shape.spacing = 0.08;
  shape.bumps = 0.05;
  shape.coloured = true;
  return test::sphere_model(shape);
}

/// A close-up that fills the image.
RenderSettings close_up(const PatchModel& model) {
  RenderSettings settings = test::small_image(model, {25.0, 20.0, 1.3});
  settings.background.reset();
  settings.outputs = test::all_outputs();
  settings.raytrace.samples = 1;
  return settings;
}

/// A scene in the split view, and in the materials that it is made of.
struct Images {
  Image split;
  Image lit;
  Image mirror;

  Images(const PatchModel& model, RenderSettings settings) {
    settings.material = Material::Split;
    split = must_render(model, settings).image;
    settings.material = Material::Lit;
    lit = must_render(model, settings).image;
    settings.material = Material::Mirror;
    mirror = must_render(model, settings).image;
  }
};

/// How many pixels show each quarter; they are compared with `images` on the way. The samples are
/// looked up where the image says that it is.
std::array<std::size_t, 5> expect_quarters(const Images& images, const std::string& what) {
  const Image& split = images.split;
  std::array<std::size_t, 5> counts{};
  std::size_t wrong = 0;
  for (std::size_t k = 0; k < values(split, "A").size(); ++k) {
    if (values(split, "A")[k] < 1.0F) continue;
    const Quarter quarter = quarter_of(split, k);
    ++counts[static_cast<std::size_t>(quarter)];
    const glm::vec3 lit = split_colour(images.lit, k);
    const glm::vec3 mirror = split_colour(images.mirror, k);
    const auto patch = static_cast<std::uint32_t>(values(split, "patch")[k]);
    const glm::vec2 uv(values(split, "UV.U")[k], values(split, "UV.V")[k]);
    const glm::vec3 expected = quarter == Quarter::Line     ? glm::vec3(1.0F)
                               : quarter == Quarter::Lit    ? lit
                               : quarter == Quarter::Mirror ? mirror
                               : quarter == Quarter::Both   ? 0.5F * (lit + mirror)
                                                            : shared::stored_samples(uv, patch - 1);
    const glm::vec3 off = glm::abs(split_colour(split, k) - expected);
    // Images are kept as half floats: 11 bits, rounded or cut off, of the split view and of both
    // that it may be the mean of.
    const float step = std::max({expected.r, expected.g, expected.b}) / 1024.0F;
    if (std::max({off.r, off.g, off.b}) > 2.0F * step) ++wrong;
  }
  EXPECT_EQ(wrong, 0U) << what;
  return counts;
}

TEST(SplitView, QuartersMatchImagesOfTheirMaterials) {
  const PatchModel model = split_bumpy_sphere();
  RenderSettings settings = close_up(model);
  settings.pixels_per_sample = 0.0;  // UV counts cells of the finest level
  for (const test::Method& method : test::all_methods()) {
    if (method.interpolation == Interpolation::Direct)
      continue;  // finds positions, as the other does
    settings.primitive = method.primitive;
    settings.interpolation = method.interpolation;
    for (const std::size_t count : expect_quarters(Images(model, settings), method.name))
      EXPECT_GT(count, 200U) << method.name;
  }
  settings.engine = "raytrace";
  for (const std::size_t count : expect_quarters(Images(model, settings), "raytrace"))
    EXPECT_GT(count, 200U) << "raytrace";
}

TEST(SplitView, HasTheSameQuartersInOrthographicImages) {
  const PatchModel model = split_bumpy_sphere();
  RenderSettings settings = close_up(model);
  settings.camera.orthographic_height = 1.2;
  settings.pixels_per_sample = 0.0;
  for (const std::string_view engine : {"onepass", "raytrace"}) {
    settings.engine = engine;
    for (const std::size_t count : expect_quarters(Images(model, settings), "orthographic"))
      EXPECT_GT(count, 200U);
  }
}

TEST(SplitView, HasALineOfOnePixelWhereTheMiddleIsAPixels) {
  const PatchModel model = split_bumpy_sphere();
  RenderSettings settings = close_up(model);
  settings.pixels_per_sample = 0.0;
  settings.width = 121;
  settings.height = 97;
  const auto counts = expect_quarters(Images(model, settings), "odd");
  EXPECT_EQ(counts[static_cast<std::size_t>(Quarter::Line)], 121U + 97U - 1U);
}

TEST(SplitView, SharesAnImageWithOtherMaterials) {
  PatchModel model = split_bumpy_sphere();
  RenderSettings settings = close_up(model);
  settings.pixels_per_sample = 0.0;
  Images images(model, settings);
  for (std::size_t k = 0; k < model.patches.size(); ++k)
    model.patches[k].material = static_cast<std::uint8_t>(k % 2);
  // Glass has a part in the variant; which environment and colours are read stays the same.
  settings.materials = {{Material::Split, {}}, {Material::Glass, {}}};
  const Image mixed = must_render(model, settings).image;
  std::size_t seen = 0;
  std::size_t different = 0;
  for (std::size_t k = 0; k < values(mixed, "A").size(); ++k) {
    const auto patch = static_cast<std::uint32_t>(values(mixed, "patch")[k]);
    if (patch == 0 || model.patches[patch - 1].material != 0) continue;
    ++seen;
    if (glm::distance(split_colour(mixed, k), split_colour(images.split, k)) > 2e-3F) ++different;
  }
  EXPECT_GT(seen, 1000U);
  EXPECT_EQ(different, 0U);
}

TEST(SplitView, PartsOfAnImageAgree) {
  const View whole = make_view({{1, 2, 3}, {0, 0, 0}, {0, 1, 0}, 45.0}, 80, 60, 0.1);
  const glm::vec3 red(1, 0, 0);
  const glm::vec3 green(0, 1, 0);
  const glm::vec3 blue(0, 0, 1);
  const auto look = [&](const View& view, glm::dvec2 window) {
    const glm::vec3 ray(glm::normalize(ray_through(view, window)));
    return shared::split_view(make_frame(view, 0.0, {}), ray, red, green, blue);
  };
  // A part right of and above the middle, with four samples along a pixel's side.
  const View part = view_of_part(whole, {42, 10, 20, 40, 4});
  for (std::uint32_t y = 0; y < part.height; ++y) {
    const double row = 10.0 + (y + 0.5) / 4.0;
    const glm::vec3 expected = std::abs(row - 30.0) < 0.75 / 4.0 ? glm::vec3(1.0F)
                               : row > 30.0                      ? green
                                                                 : 0.5F * (red + green);
    EXPECT_EQ(look(part, {7.5, y + 0.5}), expected) << y;
  }
  EXPECT_EQ(look(whole, {10.5, 10.5}), blue);
  EXPECT_EQ(look(whole, {10.5, 50.5}), red);
}

TEST(SplitView, SamplesAreDiscsOverTheirPatch) {
  const glm::vec3 between = shared::stored_samples({3.5F, 7.5F}, 4);
  EXPECT_EQ(shared::stored_samples({9.0F, 2.4F}, 4), between);
  EXPECT_NE(shared::stored_samples({3.5F, 7.5F}, 5), between);
  const glm::vec3 disc = shared::stored_samples({3.0F, 7.0F}, 4);
  EXPECT_EQ(shared::stored_samples({3.2F, 6.8F}, 4), disc);
  EXPECT_NE(shared::stored_samples({3.4F, 7.0F}, 4), disc);
  EXPECT_NE(shared::stored_samples({4.0F, 7.0F}, 4), disc);
  EXPECT_NE(shared::stored_samples({3.0F, 8.0F}, 4), disc);
}

TEST(SplitView, HasAFeatureOfItsOwn) {
  RenderSettings settings;
  settings.material = Material::Split;
  EXPECT_EQ(scene_features(settings, true),
            Features(RELIEF_FEATURE_SPLIT | RELIEF_FEATURE_LIT | RELIEF_FEATURE_MIRROR |
                         RELIEF_FEATURE_COLOURS,
                     3));
}

TEST(SplitView, IsRefusedByEnginesWithoutGridCoordinates) {
  RenderSettings settings;
  settings.material = Material::Split;
  const auto fault = [&settings](std::string_view engine, bool on_patches) {
    const Status status = check_split_view(*find_engine(engine), settings,
                                           on_patches ? ModelForm::Patches : ModelForm::Mesh);
    return status ? std::string() : status.error().message;
  };
  EXPECT_EQ(fault("onepass", true), "");
  EXPECT_EQ(fault("raytrace", true), "");
  EXPECT_NE(fault("multipass", true).find("multipass"), std::string::npos);
  EXPECT_NE(fault("ewa", true).find("ewa"), std::string::npos);
  EXPECT_NE(fault("raytrace", false).find("mesh"), std::string::npos);
  // It reaches who renders, also where the material is one of several.
  settings.engine = "multipass";
  settings.material = Material::Lit;
  settings.materials = {{Material::Lit, {}}, {Material::Split, {}}};
  Progress silent;
  EXPECT_FALSE(render(split_bumpy_sphere(), settings, silent));
}

}  // namespace
}  // namespace relief
