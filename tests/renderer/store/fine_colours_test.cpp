// Colour maps finer than the grid: exact, without neighbours' colours, filtered.
#include <gtest/gtest.h>

#include <algorithm>

#include "renderer/frame/features.h"
#include "renderer/store/maps/atlas.h"
#include "tests/renderer/images.h"

namespace relief {
namespace {

using test::must_render;
using test::values;

constexpr std::uint32_t kColourNodes = 17;
constexpr std::uint32_t kScale = 8;
constexpr std::uint32_t kSide = kScale * (kColourNodes - 1) + 1;

/// A level square with a map of kScale texels a cell; `colour` of texel (i, j).
template <class Colour>
PatchModel fine_square(const Colour& colour) {
  PatchModel model = test::height_field(kColourNodes, [](double, double) { return 0.0; });
  AttributeMap<glm::u8vec3>& map = model.patches[0].colours;
  map = {kSide, kSide, kScale, {}};
  for (std::uint32_t j = 0; j < kSide; ++j) {
    for (std::uint32_t i = 0; i < kSide; ++i) map.texels.push_back(colour(i, j));
  }
  model.has_colours = true;
  return model;
}

/// Runs `look` over the images of all methods to draw a model, multipass among them.
template <class Look>
void for_all_colour_methods(const PatchModel& model, RenderSettings settings, const Look& look) {
  settings.material = Material::Unlit;
  settings.background.reset();
  for (const test::Method& method : test::all_methods()) {
    settings.primitive = method.primitive;
    settings.interpolation = method.interpolation;
    look(must_render(model, settings), method.name);
  }
  settings.engine = "multipass";
  for (const Primitive primitive : {Primitive::Quad, Primitive::Sprite}) {
    settings.primitive = primitive;
    look(must_render(model, settings), "multipass");
  }
}

TEST(FineColours, AreAFeatureOfTheirOwn) {
  const PatchModel fine = fine_square([](auto, auto) { return glm::u8vec3(9); });
  PatchModel usual = fine;
  usual.patches[0].colours = {2 * (kColourNodes - 1) + 1, 2 * (kColourNodes - 1) + 1, 2, {}};
  usual.patches[0].colours.texels.resize(std::size_t{33} * 33);
  RenderSettings settings;
  settings.material = Material::Unlit;
  EXPECT_TRUE(scene_features(settings, ModelMaps(fine)).has(RELIEF_FEATURE_FINE_COLOURS));
  EXPECT_FALSE(scene_features(settings, ModelMaps(usual)).has(RELIEF_FEATURE_FINE_COLOURS));
  settings.material = Material::Mirror;  // which shows no colours
  EXPECT_FALSE(scene_features(settings, ModelMaps(fine)).has(RELIEF_FEATURE_FINE_COLOURS));
}

TEST(FineColours, AConstantIsReproduced) {
  for (const std::uint8_t grey : {0, 77, 188, 255}) {
    const PatchModel model = fine_square([&](auto, auto) { return glm::u8vec3(grey); });
    // Seen askew and small: several mip levels and several lookups a pixel.
    for (const std::uint32_t side : {12U, 96U}) {
      for_all_colour_methods(model, test::small_image(model, {20.0, 15.0}, side),
                             [&](const RenderResult& result, const char* method) {
                               const std::vector<float>& alpha = values(result.image, "A");
                               for (std::size_t k = 0; k < alpha.size(); ++k) {
                                 if (alpha[k] < 1.0F) continue;
                                 EXPECT_EQ(srgb8_from_linear(values(result.image, "G")[k]), grey)
                                     << method;
                               }
                             });
    }
  }
}

TEST(FineColours, MinifiedTheyAreTheMeanOfTheirLight) {
  // Stripes of one texel, four of which and more are in a pixel.
  const PatchModel model =
      fine_square([](std::uint32_t i, auto) { return glm::u8vec3(i % 2 == 0 ? 0 : 255); });
  RenderSettings settings = test::from_above(model, kColourNodes);
  settings.width = settings.height = 32;
  for_all_colour_methods(model, settings, [](const RenderResult& result, const char* method) {
    for (std::size_t y = 8; y < 24; ++y) {
      for (std::size_t x = 8; x < 24; ++x)
        // Each mip level rounds to 8 bits, half a step of which is 0.003 here.
        EXPECT_NEAR(values(result.image, "R")[y * 32 + x], 0.5F, 0.006F) << method;
    }
  });
}

TEST(FineColours, NoPatchShowsItsNeighboursInTheAtlas) {
  // Nine squares, red and blue in turns as in a layer of the array, seen ever smaller: every pixel
  // is of one of them, whatever the mip level.
  PatchModel model = fine_square([](auto, auto) { return glm::u8vec3(255, 0, 0); });
  const Patch red_square = model.patches[0];
  for (int k = 1; k < 9; ++k) {
    Patch square = red_square;
    if (k % 2 == 1)
      std::fill(square.colours.texels.begin(), square.colours.texels.end(), glm::u8vec3(0, 0, 255));
    square.origin += glm::dvec3(24.0 * (k % 3), 24.0 * (k / 3), 0.0);
    model.patches.push_back(square);
  }
  model.bounds.max += glm::dvec3(48.0, 48.0, 0.0);
  model.bounding_radius += 34.0;
  for (const std::uint32_t side : {13U, 20U, 31U, 46U, 67U, 160U}) {
    for (const Orbit orbit : {Orbit{0.0, 10.0}, Orbit{70.0, 30.0}}) {
      for_all_colour_methods(model, test::small_image(model, orbit, side),
                             [&](const RenderResult& result, const char* method) {
                               const std::vector<float>& alpha = values(result.image, "A");
                               for (std::size_t k = 0; k < alpha.size(); ++k) {
                                 if (alpha[k] < 1.0F) continue;
                                 const float red = values(result.image, "R")[k];
                                 const float light = values(result.image, "B")[k];
                                 // Whose splats of two squares blend where both are in a pixel.
                                 if (std::string(method) == "multipass") continue;
                                 EXPECT_GT(std::max(red, light), 0.999F) << method;
                                 EXPECT_LT(std::min(red, light), 0.001F) << method;
                               }
                             });
    }
  }
}

TEST(FineColours, AtlasesOfBlocksBeginAndEndAtBlocks) {
  const auto atlas = pack_atlas({{5, 9}, {16, 3}, {17, 17}}, 4096, 16, 16);
  ASSERT_TRUE(atlas);
  EXPECT_EQ(atlas->size.x % 16, 0U);
  EXPECT_EQ(atlas->size.y % 16, 0U);
  for (const AtlasSpot& spot : atlas->spots) {
    EXPECT_EQ(spot.x % 16, 0U);
    EXPECT_EQ(spot.y % 16, 0U);
  }
}

}  // namespace
}  // namespace relief
