// What an image holds: exact colours, coverage, channels, environments.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include "common/image/image_io.h"
#include "shaders/include/shared.h"
#include "tests/renderer/images.h"

namespace relief {
namespace {

using test::from_above;
using test::must_render;
using test::small_image;
using test::values;

TEST(Unlit, EveryGreyIsReproduced) {
  // 16 x 16 fields of 3 x 3 nodes, each of one grey.
  constexpr std::uint32_t kNodes = 48;
  PatchModel model = test::height_field(kNodes, [](double, double) { return 0.0; });
  Patch& patch = model.patches[0];
  patch.colours = {kNodes, kNodes, 1, {}};
  for (std::uint32_t j = 0; j < kNodes; ++j) {
    for (std::uint32_t i = 0; i < kNodes; ++i)
      patch.colours.texels.emplace_back(static_cast<std::uint8_t>(16 * (j / 3) + i / 3));
  }
  model.has_colours = true;
  RenderSettings settings = from_above(model, kNodes);
  settings.material = Material::Unlit;
  for (const test::Method& method : test::all_methods()) {
    settings.primitive = method.primitive;
    settings.interpolation = method.interpolation;
    const RenderResult result = must_render(model, settings);
    for (std::uint32_t grey = 0; grey < 256; ++grey) {
      // The field's middle node, in the image: 4 pixels a cell, rows from the top (+y).
      const std::uint32_t x = 4 * (3 * (grey % 16) + 1) + 2;
      const std::uint32_t y = 4 * kNodes - 1 - (4 * (3 * (grey / 16) + 1) + 2);
      for (const char* channel : {"R", "G", "B"}) {
        const float light = values(result.image, channel)[y * settings.width + x];
        EXPECT_EQ(srgb8_from_linear(light), grey) << method.name;
      }
    }
  }
}

TEST(Unlit, WithoutColoursIsANeutralGrey) {
  const PatchModel model = test::height_field(8, [](double, double) { return 0.0; });
  RenderSettings settings = from_above(model, 4);
  settings.material = Material::Unlit;
  const RenderResult result = must_render(model, settings);
  EXPECT_EQ(values(result.image, "R"), std::vector<float>(256, shared::kNeutralGrey));
}

TEST(Outputs, ThatAreOffAreAbsent) {
  const PatchModel model = test::sphere_model({});
  RenderSettings settings = small_image(model);
  const auto names = [&model, &settings] {
    std::string all;
    for (const Channel& channel : must_render(model, settings).image.channels)
      all += channel.name + " ";
    return all;
  };
  EXPECT_EQ(names(), "R G B A ");
  settings.outputs.depth = true;
  EXPECT_EQ(names(), "R G B A Z ");
  settings.outputs = test::all_outputs();
  EXPECT_EQ(names(), "R G B A N.X N.Y N.Z Z UV.U UV.V patch ");
}

TEST(Outputs, AreFiniteAndRaiseNoGlError) {
  // Debug contexts: a message of high severity fails the rendering.
  test::SphereShape shape;
  shape.spacing = 0.1;
  shape.bumps = 0.1;
  for (const bool coloured : {false, true}) {
    shape.coloured = coloured;
    const PatchModel model = test::sphere_model(shape);
    RenderSettings settings = small_image(model, {20.0, 15.0, 1.2});
    settings.outputs = test::all_outputs();
    for (const test::Method& method : test::all_methods()) {
      settings.primitive = method.primitive;
      settings.interpolation = method.interpolation;
      for (const Material material : {Material::Unlit, Material::Lit, Material::Mirror}) {
        settings.material = material;
        const RenderResult result = must_render(model, settings);
        for (const Channel& channel : result.image.channels) {
          const bool is_depth = channel.name == "Z";
          EXPECT_TRUE(std::all_of(channel.values.begin(), channel.values.end(),
                                  [is_depth](float v) {
                                    return std::isfinite(v) || (is_depth && v > 0 && std::isinf(v));
                                  }))
              << channel.name << " " << method.name;
        }
        ASSERT_TRUE(result.fragments);
        EXPECT_GE(*result.fragments, result.covered_pixels);
      }
    }
  }
}

TEST(Background, NoneLeavesAlphaZeroAndColourIsOpaque) {
  const PatchModel model = test::sphere_model({});
  RenderSettings settings = small_image(model);
  settings.background.reset();
  const RenderResult none = must_render(model, settings);
  settings.background = glm::vec3(0.25F, 0.5F, 1.0F);
  const RenderResult blue = must_render(model, settings);
  EXPECT_EQ(none.covered_pixels, blue.covered_pixels);
  EXPECT_GT(none.covered_pixels, 3000U);
  std::uint64_t clear = 0;
  for (std::size_t k = 0; k < values(none.image, "A").size(); ++k) {
    EXPECT_EQ(values(blue.image, "A")[k], 1.0F);
    if (values(none.image, "A")[k] != 0.0F) continue;
    ++clear;
    EXPECT_EQ(values(none.image, "R")[k], 0.0F);
    EXPECT_EQ(values(blue.image, "R")[k], 0.25F);
    EXPECT_EQ(values(blue.image, "B")[k], 1.0F);
  }
  EXPECT_EQ(clear + none.covered_pixels, values(none.image, "A").size());
}

TEST(Background, ModelWithoutPatchesIsAnEmptyImage) {
  for (const test::Method& method : test::all_methods()) {
    const PatchModel model = test::height_field(8, [](double, double) { return 0.0; });
    RenderSettings settings = small_image(model);
    settings.primitive = method.primitive;
    const RenderResult result = must_render(PatchModel{}, settings);
    EXPECT_EQ(result.covered_pixels, 0U);
    EXPECT_EQ(result.fragments, std::optional<std::uint64_t>(0));
  }
}

/// An environment file whose six directions have colours of their own.
class Environments : public testing::Test {
 protected:
  void SetUp() override {
    path_ = std::filesystem::temp_directory_path() /
            ("relief-environment-" + std::to_string(::getpid()) + ".exr");
    Image image{64, 32, {}};
    for (const char* name : {"R", "G", "B"})
      image.channels.push_back({name, ChannelType::Float, std::vector<float>(2048)});
    for (std::size_t y = 0; y < 32; ++y) {
      for (std::size_t x = 0; x < 64; ++x) {
        const glm::vec3 colour =
            colour_at(static_cast<double>(x) / 64, static_cast<double>(y) / 32);
        for (std::size_t c = 0; c < 3; ++c)
          image.channels[c].values[y * 64 + x] = colour[static_cast<glm::length_t>(c)];
      }
    }
    ASSERT_TRUE(write_exr(path_, image));
  }
  void TearDown() override { std::filesystem::remove(path_); }

  /// -Z red (middle), +X green (right), +Z blue (both ends), -X yellow (left), +Y white, -Y black.
  static glm::vec3 colour_at(double u, double v) {
    if (v < 0.25) return {1, 1, 1};
    if (v >= 0.75) return {0, 0, 0};
    if (u < 0.125 || u >= 0.875) return {0, 0, 1};
    if (u < 0.375) return {1, 1, 0};
    return u < 0.625 ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
  }

  std::filesystem::path path_;
};

TEST_F(Environments, BackdropShowsWhatLiesInEachDirection) {
  const PatchModel model = test::sphere_model({{0, 0, 1000}, 1.0, 0.2});
  RenderSettings settings = small_image(model);
  settings.environment = path_;
  const std::vector<std::pair<glm::dvec3, glm::vec3>> views{
      {{0, 0, -1}, {1, 0, 0}}, {{1, 0, 0}, {0, 1, 0}}, {{-1, 0, 0}, {1, 1, 0}},
      {{0, 0, 1}, {0, 0, 1}},  {{0, 1, 0}, {1, 1, 1}}, {{0, -1, 0}, {0, 0, 0}}};
  for (const auto& [direction, colour] : views) {
    settings.camera = {{0, 0, 0}, direction, {0.1, 1, 0.2}, 10.0};
    const RenderResult result = must_render(model, settings);
    const std::size_t middle = settings.height / 2 * settings.width + settings.width / 2;
    // The sphere stands in the +Z direction, far and small, beside the middle of no other image.
    if (direction.z < 0.5) {
      EXPECT_EQ(result.covered_pixels, 0U);
      EXPECT_EQ(values(result.image, "R")[middle], colour.x);
      EXPECT_EQ(values(result.image, "G")[middle], colour.y);
      EXPECT_EQ(values(result.image, "B")[middle], colour.z);
      EXPECT_EQ(values(result.image, "A")[middle], 1.0F);
    } else {
      EXPECT_EQ(values(result.image, "B")[0], 1.0F);
      EXPECT_EQ(values(result.image, "R")[0], 0.0F);
    }
  }
}

TEST_F(Environments, BackdropIsInNoOtherChannel) {
  const PatchModel model = test::sphere_model({});
  RenderSettings settings = small_image(model);
  settings.outputs = test::all_outputs();
  const Image without = must_render(model, settings).image;
  settings.environment = path_;
  const Image with = must_render(model, settings).image;
  EXPECT_NE(values(with, "R"), values(without, "R"));
  for (const char* channel : {"N.X", "N.Y", "N.Z", "Z", "UV.U", "UV.V", "patch"}) {
    EXPECT_EQ(values(with, channel), values(without, channel)) << channel;
  }
}

TEST_F(Environments, MirrorReflectsWhatLiesBehindTheEye) {
  const PatchModel model = test::height_field(16, [](double, double) { return 0.0; });
  RenderSettings settings = from_above(model, 8);
  settings.material = Material::Mirror;
  settings.environment = path_;
  const RenderResult result = must_render(model, settings);  // looks along -Z at a plane facing +Z
  const std::size_t middle = settings.height / 2 * settings.width + settings.width / 2;
  EXPECT_EQ(values(result.image, "R")[middle], 0.0F);
  EXPECT_EQ(values(result.image, "B")[middle], 1.0F);
}

TEST_F(Environments, BackgroundNoneHidesItButMirrorsIt) {
  const PatchModel model = test::sphere_model({});
  RenderSettings settings = small_image(model);
  settings.material = Material::Mirror;
  settings.environment = path_;
  settings.background.reset();
  const RenderResult result = must_render(model, settings);
  EXPECT_EQ(values(result.image, "A")[0], 0.0F);
  EXPECT_EQ(values(result.image, "B")[0], 0.0F);
  const std::size_t middle = settings.height / 2 * settings.width + settings.width / 2;
  EXPECT_EQ(values(result.image, "B")[middle], 1.0F);
}

// Wider than llvmpipe's targets, which end at 16384.
TEST(LargeImages, AreDrawnInPartsWithoutSeams) {
  constexpr std::uint32_t kNodes = 33;
  constexpr double kCells = kNodes - 1;
  constexpr std::uint32_t kWidth = 20000;
  constexpr std::uint32_t kHeight = 5;
  const PatchModel model = test::height_field(kNodes, [](double, double) { return 0.0; });
  RenderSettings settings = from_above(model, kNodes);
  settings.material = Material::Unlit;
  settings.width = kWidth;
  settings.height = kHeight;
  // All of the plane across, and nothing beside it.
  settings.camera.orthographic_height = kCells * kHeight / kWidth;
  settings.outputs = {true, true, true, true};
  std::vector<RenderSettings> all;
  for (const test::Method& method : test::all_methods()) {
    all.push_back(settings);
    all.back().primitive = method.primitive;
    all.back().interpolation = method.interpolation;
  }
  all.push_back(settings);
  all.back().engine = "multipass";
  for (RenderSettings& each : all) {
    for (const int samples : {1, 4}) {
      each.samples = samples;
      const RenderResult result = must_render(model, each);
      ASSERT_EQ(result.image.width, kWidth);
      ASSERT_EQ(result.image.height, kHeight);
      EXPECT_EQ(result.covered_pixels, std::uint64_t{kWidth} * kHeight) << each.engine;
      const auto alpha = values(result.image, "A");
      const auto u = values(result.image, "UV.U");
      for (std::size_t k = 0; k < alpha.size(); ++k) {
        const double expected = kCells * (static_cast<double>(k % kWidth) + 0.5) / kWidth;
        // A pixel is 1/625 of a cell; floats hold positions to 4e-6.
        ASSERT_NEAR(u[k], expected, 1e-3) << each.engine << ' ' << k;
        ASSERT_EQ(alpha[k], 1.0F) << each.engine << ' ' << k;
      }
    }
  }
}

TEST(Failures, AreOneSentence) {
  const PatchModel model = test::sphere_model({{}, 1.0, 0.2});
  RenderSettings settings = small_image(model);
  settings.width = 1U << 30U;
  Progress silent;
  auto result = render(model, settings, silent);
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().message.find("can't be drawn: a side has 1 to 32768"), std::string::npos)
      << result.error().message;

  settings = small_image(model);
  settings.environment = "/nonexistent/sky.exr";
  result = render(model, settings, silent);
  ASSERT_FALSE(result);
  EXPECT_TRUE(result.error().message.starts_with("/nonexistent/sky.exr")) << result.error().message;
}

}  // namespace
}  // namespace relief
