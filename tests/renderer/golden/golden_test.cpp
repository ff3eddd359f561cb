// Images as they were when someone last looked at them. RELIEF_UPDATE_GOLDEN=1 writes them anew:
// look at every one before it is committed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "common/image/image_io.h"
#include "common/image/srgb.h"
#include "tests/renderer/images.h"

namespace relief {
namespace {

const std::filesystem::path kFolder = RELIEF_GOLDEN_FOLDER;

struct Golden {
  const char* name;
  Material material;
  double distance;                   ///< in radii; 0: the whole model
  double orthographic_height = 0.0;  ///< 0: perspective
  int interfaces = 1;                ///< of Glass
};

PatchModel model_for(const Golden& golden) {
  test::SphereShape shape;
  shape.bumps = golden.material == Material::Mirror ? 0.0 : 0.08;
  shape.spacing = 0.08;
  shape.coloured = golden.material == Material::Unlit || golden.material == Material::Split;
  return test::sphere_model(shape);
}

/// The image of a golden image, but for the engine.
RenderSettings settings_for(const Golden& golden, const PatchModel& model) {
  RenderSettings settings = test::small_image(model, {25.0, 20.0, golden.distance});
  settings.camera.orthographic_height = golden.orthographic_height;
  settings.material = golden.material;
  settings.constants.interfaces = golden.interfaces;
  settings.background.reset();
  return settings;
}

/// Pixels of `image` with a channel (8-bit sRGB) more than `threshold` outside the range of the
/// same pixel of `golden` and its eight neighbours.
std::size_t count_strangers(const Image& golden, const Image& image, int threshold) {
  const auto level = [](const Image& of, const char* channel, std::size_t k) {
    const float value = test::values(of, channel)[k];
    return *channel == 'A' ? static_cast<int>(std::lround(255.0F * value))
                           : srgb8_from_linear(value);
  };
  const auto is_stranger = [&](const char* channel, std::size_t x, std::size_t y) {
    int min = 255;
    int max = 0;
    for (std::size_t j = y - std::min<std::size_t>(y, 1);
         j <= std::min<std::size_t>(y + 1, golden.height - 1); ++j) {
      for (std::size_t i = x - std::min<std::size_t>(x, 1);
           i <= std::min<std::size_t>(x + 1, golden.width - 1); ++i) {
        const int around = level(golden, channel, j * golden.width + i);
        min = std::min(min, around);
        max = std::max(max, around);
      }
    }
    const int drawn = level(image, channel, y * image.width + x);
    return drawn < min - threshold || drawn > max + threshold;
  };
  std::size_t strangers = 0;
  for (std::size_t y = 0; y < image.height; ++y) {
    for (std::size_t x = 0; x < image.width; ++x) {
      bool any = false;
      for (const char* channel : {"R", "G", "B", "A"}) any = any || is_stranger(channel, x, y);
      strangers += any ? 1 : 0;
    }
  }
  return strangers;
}

void expect_golden(const std::string& name, const RenderResult& result) {
  const std::filesystem::path path = kFolder / (name + ".png");
  if (std::getenv("RELIEF_UPDATE_GOLDEN") != nullptr) {
    ASSERT_TRUE(write_png(path, result.image));
    std::ofstream(kFolder / "RENDERER") << result.renderer << "\n";
    return;
  }
  const auto expected = read_image(path);
  ASSERT_TRUE(expected) << expected.error().message;
  Image image = *expected;
  if (image.find("A") == nullptr) {
    image.channels.push_back(
        {"A", ChannelType::Half, std::vector<float>(image.channels[0].values.size(), 1.0F)});
  }
  ASSERT_EQ(image.width, result.image.width);
  ASSERT_EQ(image.height, result.image.height);

  std::string recorded;
  std::ifstream file(kFolder / "RENDERER");
  std::getline(file, recorded);
  if (result.renderer == recorded) {
    EXPECT_EQ(test::count_different(image, result.image, 0), 0U);
    return;
  }
  SCOPED_TRACE("drawn by " + result.renderer + ", recorded with " + recorded);
  if (!test::drawn_by_gpu(result)) {
    // Mesa 22.3 with LLVM 15 against Mesa 25.0 with LLVM 19: 1 level in at most 21 pixels, but for
    // a mirror of quads seen close, 5 single pixels of which are 4 to 48 levels darker (why is not
    // known). Vectors of 128 bits instead of 256: none.
    const bool is_mirror_of_quads = name.starts_with("mirror_close_quad");
    EXPECT_LE(test::count_different(image, result.image, 3), is_mirror_of_quads ? 5U : 0U);
    return;
  }
  // A GPU breaks ties on rims differently. Then a pixel shows what a neighbour shows: never a new
  // colour, and not more pixels than a silhouette has.
  EXPECT_EQ(count_strangers(image, result.image, 3), 0U);
  EXPECT_LE(test::count_different(image, result.image, 3), image.width * image.height / 100);
}

TEST(GoldenRule, FindsColoursThatNoNeighbourShows) {
  const Golden lit{"lit", Material::Lit, 0.0};
  const PatchModel model = model_for(lit);
  const Image image = test::must_render(model, settings_for(lit, model)).image;
  EXPECT_EQ(count_strangers(image, image, 0), 0U);
  Image speck = image;
  const std::size_t centre = std::size_t{speck.height / 2} * speck.width + speck.width / 2;
  for (Channel& channel : speck.channels) {
    if (channel.name == "R") channel.values[centre] = 4.0F * channel.values[centre] + 1.0F;
  }
  EXPECT_EQ(count_strangers(image, speck, 3), 1U);
}

class GoldenImages : public testing::TestWithParam<std::tuple<test::Method, Golden>> {};

TEST_P(GoldenImages, AreUnchanged) {
  const auto& [method, golden] = GetParam();
  const PatchModel model = model_for(golden);
  RenderSettings settings = settings_for(golden, model);
  settings.primitive = method.primitive;
  settings.interpolation = method.interpolation;
  expect_golden(std::string(golden.name) + "_" + method.name, test::must_render(model, settings));
}

class GoldenMultipass : public testing::TestWithParam<Golden> {};

TEST_P(GoldenMultipass, AreUnchanged) {
  const PatchModel model = model_for(GetParam());
  RenderSettings settings = settings_for(GetParam(), model);
  settings.engine = "multipass";
  for (const Primitive primitive : {Primitive::Quad, Primitive::Sprite}) {
    settings.primitive = primitive;
    expect_golden(
        std::string(GetParam().name) + "_multipass_" + std::string(name_of(kPrimitives, primitive)),
        test::must_render(model, settings));
  }
}

constexpr Golden kLit{"lit", Material::Lit, 0.0};
constexpr Golden kMirrorClose{"mirror_close", Material::Mirror, 1.3};
constexpr Golden kUnlit{"unlit", Material::Unlit, 0.0};
constexpr Golden kSplit{"split", Material::Split, 1.5};
constexpr Golden kOrthographic{"orthographic", Material::Lit, 0.0, 2.3};
constexpr Golden kTwoInterfaces{"two_interfaces", Material::Glass, 0.0, 0.0, 2};

INSTANTIATE_TEST_SUITE_P(All, GoldenImages,
                         testing::Combine(testing::ValuesIn(test::all_methods()),
                                          testing::Values(kLit, kMirrorClose, kUnlit)),
                         [](const auto& both) {
                           return std::string(std::get<1>(both.param).name) + "_" +
                                  std::get<0>(both.param).name;
                         });

INSTANTIATE_TEST_SUITE_P(Split, GoldenImages,
                         testing::Combine(testing::Values(test::all_methods().back()),
                                          testing::Values(kSplit)),
                         [](const auto& /*only*/) { return std::string("cells"); });

INSTANTIATE_TEST_SUITE_P(TwoInterfaces, GoldenImages,
                         testing::Combine(testing::Values(test::all_methods().back()),
                                          testing::Values(kTwoInterfaces)),
                         [](const auto& /*only*/) { return std::string("cells"); });

INSTANTIATE_TEST_SUITE_P(Orthographic, GoldenImages,
                         testing::Combine(testing::Values(test::all_methods().back()),
                                          testing::Values(kOrthographic)),
                         [](const auto& /*only*/) { return std::string("cells"); });

INSTANTIATE_TEST_SUITE_P(All, GoldenMultipass, testing::Values(kLit, kMirrorClose, kUnlit),
                         [](const auto& golden) { return std::string(golden.param.name); });

}  // namespace
}  // namespace relief
