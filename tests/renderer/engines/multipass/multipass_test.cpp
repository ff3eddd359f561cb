// The engine `multipass`: what blending must keep, what it must part, and where it agrees with
// `onepass`.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "renderer/frame/features.h"
#include "renderer/frame/gl_model.h"
#include "renderer/frame/splat_sums.h"
#include "shaders/include/shared.h"
#include "tests/renderer/images.h"

namespace relief {
namespace {

using test::from_above;
using test::must_render;
using test::small_image;
using test::values;

/// A primitive and a radius factor.
struct SplatMethod {
  Primitive primitive;
  double radius_factor;
  const char* name;
};

class Multipass : public testing::TestWithParam<SplatMethod> {
 protected:
  static RenderSettings with_method(RenderSettings settings) {
    settings.engine = "multipass";
    settings.primitive = GetParam().primitive;
    settings.multipass.radius_factor = GetParam().radius_factor;
    return settings;
  }
};

void paint(Patch& patch, std::uint8_t grey) {
  patch.colours = {patch.width, patch.height, 1, {}};
  patch.colours.texels.assign(std::size_t{patch.width} * patch.height, glm::u8vec3(grey));
}

std::size_t count_infinite(const Image& image) {
  std::size_t infinite = 0;
  for (const Channel& channel : image.channels) {
    const bool is_depth = channel.name == "Z";
    infinite += static_cast<std::size_t>(
        std::count_if(channel.values.begin(), channel.values.end(), [is_depth](float v) {
          return !std::isfinite(v) && !(is_depth && v > 0.0F && std::isinf(v));
        }));
  }
  return infinite;
}

TEST_P(Multipass, SumsAreNormalised) {
  // One grey and one slope: whatever the weights are, their means are the same.
  const glm::vec3 normal = glm::normalize(glm::vec3(-0.5F, -0.25F, 1.0F));
  PatchModel model = test::height_field(48, [](double x, double y) { return 0.5 * x + 0.25 * y; });
  for (const std::uint8_t grey : {3, 128, 254}) {
    paint(model.patches[0], grey);
    model.has_colours = true;
    RenderSettings settings = with_method(from_above(model, 32));
    settings.material = Material::Unlit;
    settings.outputs.normal = true;
    const RenderResult result = must_render(model, settings);
    EXPECT_EQ(result.covered_pixels, std::uint64_t{settings.width} * settings.height);
    for (std::size_t k = 0; k < values(result.image, "R").size(); ++k) {
      ASSERT_EQ(srgb8_from_linear(values(result.image, "R")[k]), grey) << k;
      const glm::vec3 seen(values(result.image, "N.X")[k], values(result.image, "N.Y")[k],
                           values(result.image, "N.Z")[k]);
      // Seven or so splats are added in half floats, each rounded by 2^-12 at most, and the output
      // is a half float again: 0.002.
      ASSERT_LT(glm::distance(seen, normal), 0.002F) << k;
    }
  }
}

TEST_P(Multipass, SheetsNearEachOtherBlendAndOthersHide) {
  // A dark sheet below a bright one: within kBlendingDepth both count, beyond it the nearer alone.
  PatchModel model = test::height_field(32, [](double, double) { return 0.0; });
  paint(model.patches[0], 0);
  model.has_colours = true;
  model.patches.push_back(model.patches[0]);
  paint(model.patches[1], 255);
  RenderSettings settings = with_method(from_above(model, 16));
  settings.material = Material::Unlit;
  const std::size_t middle = settings.height / 2 * settings.width + settings.width / 2;
  const auto brightness = [&](double cells) {
    model.patches[1].origin.z = model.patches[0].origin.z + cells;
    return values(must_render(model, settings).image, "R")[middle];
  };
  // In the middle of the image both are seen at the same position of the grid, with the same
  // weights.
  EXPECT_NEAR(brightness(0.9 * double{shared::kBlendingDepth}), 0.5F, 0.02F);
  EXPECT_EQ(brightness(1.1 * double{shared::kBlendingDepth}), 1.0F);
}

TEST_P(Multipass, SidesOfAThinPlateDoNotBlend) {
  // The back lies within the depth of blending, and faces away.
  PatchModel model = test::height_field(32, [](double, double) { return 0.0; });
  paint(model.patches[0], 0);
  model.has_colours = true;
  model.patches.push_back(model.patches[0]);
  paint(model.patches[1], 255);
  model.patches[1].origin.z += 0.5 * double{shared::kBlendingDepth};
  // Turned about the patch's own first axis, so that it still lies over the other.
  glm::dmat3& axes = model.patches[0].axes;
  model.patches[0].origin +=
      axes[1] * double(model.patches[0].height - 1) * model.patches[0].spacing;
  axes[1] = -axes[1];
  axes[2] = -axes[2];
  RenderSettings settings = with_method(from_above(model, 16));
  settings.material = Material::Unlit;
  settings.cull = CullMode::None;
  settings.outputs.normal = true;
  const Image image = must_render(model, settings).image;
  const std::size_t middle = settings.height / 2 * settings.width + settings.width / 2;
  EXPECT_EQ(values(image, "R")[middle], 1.0F);
  EXPECT_GT(values(image, "N.Z")[middle], 0.99F);
}

TEST_P(Multipass, CoversWhatOnepassCovers) {
  // Both draw the quads that tile the surface; the discs of pass 2 reach further and are cut off.
  test::SphereShape shape;
  shape.bumps = 0.1;
  const PatchModel model = test::sphere_model(shape);
  for (const double distance : {0.0, 1.4}) {
    RenderSettings settings = small_image(model, {30.0, 20.0, distance});
    settings.interpolation = Interpolation::Direct;
    const Image one = must_render(model, settings).image;
    const Image three = must_render(model, with_method(settings)).image;
    std::size_t different = 0;
    for (std::size_t k = 0; k < values(one, "A").size(); ++k)
      different += values(one, "A")[k] != values(three, "A")[k] ? 1 : 0;
    // A pixel's middle on the side of a quad may fall to either: 200 pixels of rim, sides snapped
    // to 1/256 pixel.
    EXPECT_LE(different, 2U) << distance;
  }
}

TEST_P(Multipass, SplatsLargerThanSpritesAreDrawn) {
  // A third of a cell above the ground: splats of more than 255 pixels, OpenGL's least limit here,
  // and splats that reach behind the eye.
  const PatchModel model =
      test::height_field(20, [](double x, double y) { return 0.1 * std::sin(x) * std::cos(y); });
  RenderSettings settings = with_method(small_image(model, {}, 400));
  settings.camera = {{0.1, 0.2, 0.35}, {0.6, 0.3, 0.0}, {0.0, 0.0, 1.0}, 60.0};
  settings.outputs.depth = true;
  const RenderResult result = must_render(model, settings);
  EXPECT_EQ(result.covered_pixels, std::uint64_t{settings.width} * settings.height);
  EXPECT_EQ(count_infinite(result.image), 0U);
}

TEST_P(Multipass, IsNearToOnepassOnASphere) {
  // Normals of a sphere at 2.9 degrees a cell; weights that are not symmetric about a pixel pull
  // the mean by a part of that.
  const PatchModel model = test::sphere_model({});
  RenderSettings settings = small_image(model, {30.0, 20.0, 1.6});
  settings.outputs = test::all_outputs();
  const Image one = must_render(model, settings).image;
  const Image three = must_render(model, with_method(settings)).image;
  double degrees = 0.0;
  double cells = 0.0;
  double count = 0.0;
  for (std::size_t k = 0; k < values(one, "A").size(); ++k) {
    if (values(one, "A")[k] == 0.0F || values(three, "A")[k] == 0.0F) continue;
    const auto normal = [k](const Image& image) {
      return glm::dvec3(values(image, "N.X")[k], values(image, "N.Y")[k], values(image, "N.Z")[k]);
    };
    degrees += std::pow(glm::distance(normal(one), normal(three)) * 180.0 / std::acos(-1.0), 2.0);
    cells += std::pow((values(one, "Z")[k] - values(three, "Z")[k]) / 0.05, 2.0);
    count += 1.0;
  }
  EXPECT_GT(count, 3000.0);
  EXPECT_LT(std::sqrt(degrees / count), 1.0);  // a third of a cell
  EXPECT_LT(std::sqrt(cells / count), 0.5);    // rims, where a cell is seen at grazing angles
}

TEST_P(Multipass, NoisePlanesAndManySamplesAPixelHaveNoHoles) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> noise(-0.3, 0.3);
  PatchModel bumpy = test::height_field(90, [&](double x, double y) {
    return 2.0 * std::sin(0.5 * x) * std::cos(0.4 * y) + noise(random);
  });
  bumpy.patches[0].normals = {};
  const PatchModel steep = test::height_field(64, [](double x, double) { return 4.0 * x; });
  RenderSettings settings = with_method(small_image(bumpy));
  settings.outputs.depth = true;
  const auto expect_full = [&settings](const PatchModel& model, glm::dvec3 eye, double fov) {
    settings.camera = {eye, {0.0, 0.0, 0.0}, {0.3, 1.0, 0.2}, fov};
    const RenderResult result = must_render(model, settings);
    EXPECT_EQ(result.covered_pixels, std::uint64_t{settings.width} * settings.height);
    // A pixel that no disc of pass 2 covers would have the depth 0 / 0.
    EXPECT_EQ(count_infinite(result.image), 0U);
  };
  expect_full(bumpy, {0.0, -19.0, 23.0}, 40.0);
  const glm::dvec3 facing = glm::normalize(glm::dvec3(-4.0, 0.0, 1.0));
  expect_full(steep, 6.0 * facing, 45.0);
  expect_full(steep, 3000.0 * facing, 0.5);
}

TEST_P(Multipass, EdgeOnAndBehindTheEyeIsFinite) {
  // Debug contexts: a message of high severity fails the rendering, too.
  test::SphereShape shape;
  shape.spacing = 0.1;
  shape.coloured = true;
  const PatchModel sphere = test::sphere_model(shape);
  const PatchModel plane = test::height_field(40, [](double, double) { return 0.0; });
  RenderSettings settings = with_method(small_image(sphere));
  settings.outputs = test::all_outputs();
  for (const Material material : {Material::Unlit, Material::Lit, Material::Mirror}) {
    settings.material = material;
    // In the middle of the sphere, just within and just outside of its surface.
    for (const double distance : {0.0, 0.99, 1.02}) {
      settings.camera = {{0.0, 0.0, distance}, {0.1, 0.2, -1.0}, {0.0, 1.0, 0.0}, 60.0};
      const RenderResult result = must_render(sphere, settings);
      EXPECT_EQ(count_infinite(result.image), 0U) << distance;
      EXPECT_GT(result.covered_pixels, distance < 1.0 ? 11000U : 1000U) << distance;
      ASSERT_TRUE(result.fragments);
      EXPECT_GE(*result.fragments, 2 * result.covered_pixels);
    }
    // Within the plane and close above it, over its middle.
    for (const double height : {0.0, 1e-6, 0.01}) {
      settings.camera = {{0.0, 0.0, height}, {10.0, 0.5, height}, {0.0, 0.0, 1.0}, 60.0};
      EXPECT_EQ(count_infinite(must_render(plane, settings).image), 0U) << height;
    }
  }
}

TEST_P(Multipass, ViewsAndEnginesDoNotDisturbEachOther) {
  const PatchModel model = test::sphere_model({});
  std::vector<RenderSettings> views;
  for (const std::uint32_t side : {64U, 40U, 96U})
    views.push_back(with_method(small_image(model, {20.0, 15.0, 1.4}, side)));
  views[1].engine = "onepass";
  views[2].outputs = test::all_outputs();
  Progress silent;
  std::vector<Image> results(views.size());
  ASSERT_TRUE(render_views(
      RenderModel::of(model), views,
      [&results](std::size_t view, const RenderResult& result) {
        results[view] = result.image;
        return Status();
      },
      silent));
  for (std::size_t i = 0; i < views.size(); ++i) {
    const Image alone = must_render(model, views[i]).image;
    ASSERT_EQ(results[i].channels.size(), alone.channels.size());
    for (std::size_t c = 0; c < alone.channels.size(); ++c)
      EXPECT_EQ(results[i].channels[c].values, alone.channels[c].values);
  }
}

INSTANTIATE_TEST_SUITE_P(All, Multipass,
                         testing::Values(SplatMethod{Primitive::Quad, 1.0, "quad_1"},
                                         SplatMethod{Primitive::Quad, 2.0, "quad_2"},
                                         SplatMethod{Primitive::Sprite, 1.0, "sprite_1"},
                                         SplatMethod{Primitive::Sprite, 2.0, "sprite_2"}),
                         [](const auto& method) { return std::string(method.param.name); });

TEST(MultipassSums, AreThoseThatTheImageNeeds) {
  const PatchModel model = test::height_field(4, [](double, double) { return 0.0; });
  RenderSettings settings = small_image(model);
  const auto opengl = OpenGl::create(settings.platform, settings.debug, false);
  ASSERT_TRUE(opengl);
  const auto gpu = GlModel::create(
      {.opengl = *opengl, .environments = std::make_shared<EnvironmentCache>(), .patches = model});
  ASSERT_TRUE(gpu);
  const auto sums_of = [&](bool coloured) {
    const auto frame = (*gpu)->make_frame(settings, {0, 0, settings.width, settings.height, 1});
    EXPECT_TRUE(frame);
    const auto sums = make_sums((*gpu)->gl(), frame->targets, scene_features(settings, coloured));
    EXPECT_TRUE(sums);
    return std::string(sums->normals ? "normals " : "") + (sums->colours ? "colours " : "") +
           (sums->depths ? "depths " : "");
  };
  settings.material = Material::Unlit;
  EXPECT_EQ(sums_of(false), "");
  EXPECT_EQ(sums_of(true), "colours ");
  settings.material = Material::Mirror;
  EXPECT_EQ(sums_of(true), "normals ");
  settings.material = Material::Lit;
  settings.outputs.depth = true;
  EXPECT_EQ(sums_of(true), "normals colours depths ");
}

}  // namespace
}  // namespace relief
