// Several samples a pixel, of the engines on OpenGL.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "renderer/frame/image_parts.h"
#include "renderer/view/uniforms.h"
#include "renderer/view/view.h"
#include "tests/renderer/images.h"

namespace relief {
namespace {

using test::must_render;
using test::values;

constexpr std::uint32_t kSampledNodes = 9;
/// A patch's border splats reach half a cell beyond its nodes.
constexpr double kEdge = 0.5 * kSampledNodes;

/// Straight down on the plane of kSampledNodes x kSampledNodes cells, turned, `side` pixels for 2
/// kEdge cells: an upright or level edge would meet all samples of a column at once.
RenderSettings turned_image(std::uint32_t side, double turn_degrees) {
  const double turn = glm::radians(turn_degrees);
  RenderSettings settings;
  settings.width = settings.height = side;
  settings.camera = {{kEdge, 0.0, kEdge / std::tan(glm::radians(22.5))},
                     {kEdge, 0.0, 0.0},
                     {-std::sin(turn), std::cos(turn), 0.0},
                     45.0};
  settings.material = Material::Unlit;
  settings.count_fragments = true;
  settings.debug = true;
  return settings;
}

PatchModel plane() {
  return test::height_field(kSampledNodes, [](double, double) { return 0.0; });
}

/// How near to the corner of the plane its edge is no straight line, in cells.
double corner_of(Primitive primitive) {
  return primitive == Primitive::Cell ? 2.5 : 0.5;
}

/// How many of a pixel's samples lie on the inner side of the plane's right edge.
struct ExpectedMean {
  int inside = 0;
  int undecided = 0;       ///< so near to the edge that rounding may decide
  bool at_corner = false;  ///< of the plane, which is no half plane there
};

ExpectedMean count_inside(const RenderSettings& settings, std::size_t x, std::size_t y, int side) {
  const double corner = corner_of(settings.primitive);
  const double pixel = 2.0 * kEdge / settings.width;
  const glm::dvec2 up(settings.camera.up);
  const glm::dvec2 right(up.y, -up.x);
  ExpectedMean expected;
  for (int b = 0; b < side; ++b) {
    for (int a = 0; a < side; ++a) {
      const double across = (static_cast<double>(x) + (a + 0.5) / side) * pixel - kEdge;
      const double upward = kEdge - (static_cast<double>(y) + (b + 0.5) / side) * pixel;
      const glm::dvec2 position = glm::dvec2(kEdge, 0.0) + across * right + upward * up;
      const double beyond = position.x - kEdge;
      // Border splats are larger by a fiftieth of a cell and of a pixel; corners snap to 1/256
      // pixel.
      const bool near = std::abs(beyond) < 0.02 + 0.025 * pixel;
      expected.undecided += near ? 1 : 0;
      expected.inside += beyond < 0.0 && !near ? 1 : 0;
      expected.at_corner = expected.at_corner || std::abs(position.y) > kEdge - corner;
    }
  }
  return expected;
}

class ViewOfPart : public testing::TestWithParam<double> {};

TEST_P(ViewOfPart, MatchesTheImage) {
  Camera camera{{1.0, 2.0, 9.0}, {0.0, 0.5, 0.0}, {0.1, 1.0, 0.0}, 50.0};
  camera.orthographic_height = GetParam();
  const View whole = make_view(camera, 90, 60, 0.01);
  const Raster raster{70, 10, 15, 40, 3};
  const View part = view_of_part(whole, raster);
  EXPECT_EQ(part.width, 45U);
  EXPECT_EQ(part.height, 120U);
  for (const glm::dvec2 window :
       {glm::dvec2(0.0), glm::dvec2(45.0, 120.0), glm::dvec2(7.5, 31.5)}) {
    const glm::dvec2 in_whole = glm::dvec2(70.0, 10.0) + window / 3.0;
    const glm::dvec3 ray = ray_through(part, window);
    // Double precision throughout.
    EXPECT_LT(glm::distance(ray, ray_through(whole, in_whole)), 1e-14);
    const glm::dvec3 start = ray_start(part, window);
    EXPECT_LT(glm::distance(start, ray_start(whole, in_whole)), 1e-14);
    const glm::dvec4 clip = part.projection * glm::dvec4(part.rotation * (start + ray), 1.0);
    const glm::dvec2 projected =
        (glm::dvec2(clip) / clip.w + 1.0) * 0.5 * glm::dvec2(part.width, part.height);
    // The projection is made of floats.
    EXPECT_LT(glm::distance(projected, window), 1e-4);
    const shared::Frame frame = make_frame(part, 0.0, {});
    const glm::dvec3 drawn = glm::dvec3(frame.ray_origin) + window.x * glm::dvec3(frame.ray_x) +
                             window.y * glm::dvec3(frame.ray_y);
    EXPECT_LT(glm::distance(drawn, part.orthographic ? start : ray), 1e-5);
  }
  // A small thing is seen where it is and nowhere else.
  for (const glm::dvec2 middle : {glm::dvec2(0.5), glm::dvec2(-0.05, 0.5), glm::dvec2(1.05, 0.5),
                                  glm::dvec2(0.5, -0.05), glm::dvec2(0.5, 1.05)}) {
    const glm::dvec2 window = middle * glm::dvec2(part.width, part.height);
    const bool within = middle == glm::dvec2(0.5);
    const glm::dvec3 position = ray_start(part, window) + 5.0 * ray_through(part, window);
    EXPECT_EQ(sees_sphere(part, part.eye + position, 1e-3), within);
    EXPECT_FALSE(sees_sphere(part, part.eye - position, 1e-3)) << "behind the eye";
  }
}

TEST_P(ViewOfPart, OfTheWholeImageIsIdentical) {
  Camera camera{{1.0, 2.0, 9.0}, {}, {0.0, 1.0, 0.0}, 50.0};
  camera.orthographic_height = GetParam();
  const View whole = make_view(camera, 90, 70, 0.01);
  const View part = view_of_part(whole, {0, 0, 90, 70, 1});
  EXPECT_EQ(part.projection, whole.projection);
  EXPECT_EQ(part.middle, whole.middle);
  EXPECT_EQ(part.slope_x, whole.slope_x);
  EXPECT_EQ(part.slope_y, whole.slope_y);
}

INSTANTIATE_TEST_SUITE_P(All, ViewOfPart, testing::Values(0.0, 7.0), [](const auto& height) {
  return height.param > 0.0 ? "orthographic" : "perspective";
});

std::vector<RenderSettings> methods(const RenderSettings& settings) {
  std::vector<RenderSettings> all;
  for (const test::Method& method : test::all_methods()) {
    all.push_back(settings);
    all.back().primitive = method.primitive;
    all.back().interpolation = method.interpolation;
  }
  for (const Primitive primitive : {Primitive::Sprite, Primitive::Quad}) {
    all.push_back(settings);
    all.back().engine = "multipass";
    all.back().primitive = primitive;
  }
  return all;
}

TEST(SamplesASide, HoldAtLeastAsMany) {
  const std::vector<std::pair<int, std::uint32_t>> sides{
      {1, 1}, {2, 2}, {4, 2}, {5, 3}, {8, 3}, {9, 3}, {16, 4}, {17, 5}, {64, 8}, {65536, 256}};
  for (const auto& [samples, side] : sides) EXPECT_EQ(samples_a_side(samples), side) << samples;
}

TEST(ImageParts, CoverEachPixelOnceAndFitIntoTargets) {
  struct Case {
    std::uint32_t width, height, side, largest;
  };
  for (const Case& c : {Case{1280, 1024, 2, 16384},
                        {1280, 1024, 4, 16384},
                        {5000, 8, 4, 16384},
                        {7, 5, 256, 256},
                        {4096, 4096, 3, 8192},
                        {1, 32768, 1, 100}}) {
    std::vector<int> covered(std::size_t{c.width} * c.height, 0);
    for (const Raster& part : parts_of(c.width, c.height, c.side, c.largest)) {
      EXPECT_EQ(part.side, c.side);
      EXPECT_LE(part.width * part.side, c.largest);
      EXPECT_LE(part.height * part.side, c.largest);
      EXPECT_LE(std::uint64_t{part.width} * part.height * c.side * c.side, kMaxPartSamples);
      for (std::uint32_t y = 0; y < part.height; ++y) {
        for (std::uint32_t x = 0; x < part.width; ++x)
          ++covered[std::size_t{part.bottom + y} * c.width + part.left + x];
      }
    }
    EXPECT_EQ(covered, std::vector<int>(covered.size(), 1));
  }
  EXPECT_EQ(parts_of(1280, 1024, 2, 16384).size(), 1U);
}

TEST(Supersampling, CoverageOfASlantedEdgeIsTheShareOfSamplesBehindIt) {
  const PatchModel model = plane();
  for (const Primitive primitive : {Primitive::Cell, Primitive::Quad}) {
    RenderSettings settings = turned_image(24, 17.0);
    settings.primitive = primitive;
    settings.background.reset();
    for (const int side : {2, 3, 4}) {
      settings.samples = side * side;
      const RenderResult result = must_render(model, settings);
      const std::vector<float>& alpha = values(result.image, "A");
      std::size_t partial = 0;
      for (std::size_t y = 0; y < settings.height; ++y) {
        for (std::size_t x = 0; x < settings.width; ++x) {
          const ExpectedMean expected = count_inside(settings, x, y, side);
          if (expected.at_corner) continue;
          const std::size_t k = y * settings.width + x;
          const float samples = static_cast<float>(side * side);
          const float least = static_cast<float>(expected.inside) / samples;
          const float most = least + static_cast<float>(expected.undecided) / samples;
          partial += least > 0.0F && most < 1.0F ? 1 : 0;
          // Coverage is a half float, of eleven bits.
          EXPECT_GE(alpha[k], least - 0.5e-3F) << side << " " << x << "," << y;
          EXPECT_LE(alpha[k], most + 0.5e-3F) << side << " " << x << "," << y;
          // Premultiplied: a grey of 0.5.
          EXPECT_NEAR(values(result.image, "R")[k], 0.5F * alpha[k], 0.5e-3);
        }
      }
      // Along half as much of it with cells.
      EXPECT_GT(partial, primitive == Primitive::Cell ? 3U : 8U)
          << "no pixel of the edge was looked at";
    }
  }
}

/// The mean of an image's squares of `side` by `side` pixels.
std::vector<float> shrink(const Image& image, const char* channel, std::uint32_t side) {
  const std::vector<float>& large = values(image, channel);
  const std::size_t width = image.width / side;
  std::vector<float> small(width * (image.height / side), 0.0F);
  for (std::size_t k = 0; k < large.size(); ++k)
    small[k / image.width / side * width + k % image.width / side] += large[k];
  for (float& value : small) value /= static_cast<float>(side * side);
  return small;
}

TEST(Supersampling, IsTheMeanOfALargerImage) {
  test::SphereShape shape;
  shape.bumps = 0.1;
  shape.coloured = true;
  const PatchModel model = test::sphere_model(shape);
  for (RenderSettings settings : methods(test::small_image(model))) {
    settings.background.reset();
    settings.environment.clear();
    RenderSettings large = settings;
    large.width *= 3;
    large.height *= 3;
    if (pixels_per_sample_of(settings) > 0.0)
      large.pixels_per_sample = 3.0 * pixels_per_sample_of(settings);
    const RenderResult expected = must_render(model, large);
    settings.samples = 9;
    const RenderResult result = must_render(model, settings);
    EXPECT_EQ(result.fragments, expected.fragments);
    for (const char* channel : {"R", "G", "B", "A"}) {
      const std::vector<float> mean = shrink(expected.image, channel, 3);
      for (std::size_t k = 0; k < mean.size(); ++k) {
        // The mean is a half float.
        ASSERT_NEAR(values(result.image, channel)[k], mean[k], 1e-3F * mean[k] + 1e-6F);
      }
    }
  }
}

/// A hill of height 6 in the middle of a plane of 33 x 33 nodes, light and dark in waves along x,
/// so that colours are the same bilinear over cells, as drawn, and linear over triangles, as
/// traced.
PatchModel hill() {
  test::Grid grid;
  grid.origin = {-16.0, -16.0, 0.0};
  grid.width = grid.height = 33;
  return test::model_of({test::sample_patch(
      grid,
      [](glm::dvec3 p) {
        const double wave = std::sin(0.7 * p.x);
        return test::SurfacePoint{6.0 * std::exp(-(p.x * p.x + p.y * p.y) / 50.0),
                                  {0.0, 0.0, 1.0},
                                  glm::u8vec3(static_cast<std::uint8_t>(128.0 + 100.0 * wave))};
      },
      true)});
}

TEST(Supersampling, AgreesWithAsManyRays) {
  const PatchModel model = hill();
  RenderSettings settings = test::small_image(model);
  settings.camera = {{0.0, -60.0, 8.0}, {0.0, 0.0, 3.0}, {0.0, 0.0, 1.0}, 20.0};
  settings.material = Material::Unlit;
  settings.background.reset();
  settings.pixels_per_sample = 0.0;
  settings.samples = 64;
  settings.raytrace.samples = 64;
  const RenderResult drawn = must_render(model, settings);
  settings.engine = "raytrace";
  const RenderResult traced = must_render(model, settings);
  std::size_t partial = 0;
  std::size_t opaque = 0;
  float sum = 0.0F;
  for (std::size_t k = 0; k < values(drawn.image, "A").size(); ++k) {
    const glm::dvec3 ray = test::pixel_ray(settings, k % settings.width, k / settings.width);
    // Below, border splats are seen, which rays don't know.
    if (settings.camera.eye.z - ray.z / ray.y * settings.camera.eye.y < 2.2) continue;
    const float a = values(drawn.image, "A")[k];
    const float b = values(traced.image, "A")[k];
    // Of a half plane the grid of 64 samples errs by 0.060, the rays' pattern by 0.052.
    EXPECT_NEAR(a, b, 0.112F) << k;
    partial += a > 0.0F && a < 1.0F ? 1 : 0;
    if (a < 1.0F || b < 1.0F) continue;
    const float difference = std::abs(values(drawn.image, "R")[k] - values(traced.image, "R")[k]);
    // Below the ridge a pixel sees a wave at a grazing angle, an edge of contrast 0.77 at most.
    EXPECT_LT(difference, 0.77F * 0.112F) << k;
    sum += difference;
    ++opaque;
  }
  EXPECT_GT(partial, 40U);
  EXPECT_GT(opaque, 500U);
  // Half floats are off by 1.2e-4, and the pixels at a grazing angle, a twentieth, by up to 0.02.
  EXPECT_LT(sum / static_cast<float>(opaque), 1.2e-3F);
}

TEST(Supersampling, TheBackgroundIsMixedInLinearLight) {
  const PatchModel model = plane();
  RenderSettings settings = turned_image(24, 17.0);
  settings.samples = 16;
  settings.background.reset();
  const RenderResult alone = must_render(model, settings);
  settings.background = glm::vec3(1.0F, 0.25F, 0.0F);
  const RenderResult over = must_render(model, settings);
  EXPECT_EQ(values(over.image, "A"), std::vector<float>(24 * 24, 1.0F));
  EXPECT_EQ(alone.covered_pixels, over.covered_pixels);
  for (std::size_t k = 0; k < 24 * 24; ++k) {
    const float behind = 1.0F - values(alone.image, "A")[k];
    // Two half floats and their sum's.
    EXPECT_NEAR(values(over.image, "R")[k], values(alone.image, "R")[k] + behind, 1.5e-3);
    EXPECT_NEAR(values(over.image, "G")[k], values(alone.image, "G")[k] + 0.25F * behind, 1.5e-3);
    EXPECT_NEAR(values(over.image, "B")[k], values(alone.image, "B")[k], 1.5e-3);
  }
}

TEST(Supersampling, GeometryIsThatOfThePixelsMiddle) {
  test::SphereShape shape;
  shape.bumps = 0.1;
  const PatchModel model = test::sphere_model(shape);
  for (RenderSettings settings : methods(test::small_image(model))) {
    settings.outputs = test::all_outputs();
    const RenderResult once = must_render(model, settings);
    settings.samples = 4;
    const RenderResult often = must_render(model, settings);
    ASSERT_EQ(once.image.channels.size(), often.image.channels.size());
    for (const char* channel : {"N.X", "N.Y", "N.Z", "Z", "UV.U", "UV.V", "patch"})
      EXPECT_EQ(values(once.image, channel), values(often.image, channel)) << channel;
    EXPECT_NE(values(once.image, "R"), values(often.image, "R"));
    EXPECT_GT(*often.fragments, 4 * *once.fragments);
  }
}

/// A plane whose colour's light rises evenly from left to right.
PatchModel ramp() {
  constexpr std::uint32_t kSide = 65;
  test::Grid grid;
  grid.origin = {-32.0, -32.0, 0.0};
  grid.width = grid.height = kSide;
  return test::model_of({test::sample_patch(
      grid,
      [](glm::dvec3 p) {
        const auto level =
            static_cast<std::uint8_t>(srgb8_from_linear(static_cast<float>((p.x + 40.0) / 80.0)));
        return test::SurfacePoint{0.0, {0.0, 0.0, 1.0}, glm::u8vec3(level)};
      },
      true)});
}

TEST(Supersampling, PartsMeetWithoutASeam) {
  const PatchModel model = ramp();
  RenderSettings plain;
  // 20,000 samples wide: more than llvmpipe's 16,384, so in two parts.
  plain.width = 5000;
  plain.height = 8;
  plain.camera = {{0.0, 0.0, 0.08}, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, 45.0};
  plain.material = Material::Unlit;
  plain.count_fragments = true;
  plain.debug = true;
  plain.pixels_per_sample = 0.0;
  for (RenderSettings settings : methods(plain)) {
    const RenderResult once = must_render(model, settings);
    settings.samples = 16;
    const RenderResult often = must_render(model, settings);
    EXPECT_EQ(often.covered_pixels, 5000U * 8U);
    for (std::size_t k = 0; k < 5000 * 8; ++k) {
      // Light is linear over a pixel but for the kinks at grid lines; half floats.
      ASSERT_NEAR(values(often.image, "R")[k], values(once.image, "R")[k], 2e-3) << k;
    }
  }
}

}  // namespace
}  // namespace relief
