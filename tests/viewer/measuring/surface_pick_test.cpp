// Picked points against surfaces that are known, and against what engines draw.
#include "viewer/measuring/surface_pick.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <random>

#include "common/transform.h"
#include "preprocess/convert.h"
#include "preprocess/readers/read_points.h"
#include "tests/renderer/images.h"

namespace relief {
namespace {

namespace fs = std::filesystem;
using test::small_image;
using test::values;

/// What single precision makes of a depth on the GPU, relative.
constexpr double kDepthError = 1e-6;

/// A pixel of an image in which a patch is seen, as a query and what was drawn.
struct Seen {
  PickQuery query;
  glm::dvec3 drawn{0.0};
  glm::dvec3 normal{0.0};
};

/// The query for pixel k of an image.
Seen seen_at(const RenderSettings& settings, const Image& image, std::size_t k) {
  const std::size_t x = k % settings.width;
  const std::size_t y = k / settings.width;
  Seen seen;
  seen.query.start = settings.camera.eye;
  seen.query.direction = test::pixel_ray(settings, x, y);
  seen.query.depth = values(image, "Z")[k];
  seen.query.patch = static_cast<std::uint32_t>(values(image, "patch")[k]) - 1;
  const double slope = std::tan(settings.camera.vertical_fov_degrees * std::acos(-1.0) / 360.0);
  seen.query.pixel = 2.0 * slope * seen.query.depth / settings.height;
  seen.drawn = seen.query.start + seen.query.depth * seen.query.direction;
  seen.normal = {values(image, "N.X")[k], values(image, "N.Y")[k], values(image, "N.Z")[k]};
  return seen;
}

std::vector<std::size_t> covered_pixels(const Image& image) {
  std::vector<std::size_t> covered;
  for (std::size_t k = 0; k < values(image, "patch").size(); ++k) {
    if (values(image, "patch")[k] > 0.0F) covered.push_back(k);
  }
  return covered;
}

std::vector<Seen> all_seen(const RenderSettings& settings, const Image& image) {
  std::vector<Seen> seen;
  for (const std::size_t k : covered_pixels(image)) seen.push_back(seen_at(settings, image, k));
  return seen;
}

RenderSettings with_outputs(RenderSettings settings, const char* engine) {
  settings.engine = engine;
  settings.outputs = test::all_outputs();
  settings.count_fragments = false;
  settings.pixels_per_sample = 0.0;
  return settings;
}

/// A plane through `origin` whose heights rise by a quarter of a cell along the patch's columns and
/// sink by half a cell along its rows: whole height steps, so that it is exact.
Patch tilted_plane(glm::dvec3 origin, const glm::dmat3& axes) {
  const test::Surface surface = [&](glm::dvec3 base) {
    const glm::dvec3 local = glm::transpose(axes) * (base - origin);
    const glm::dvec3 normal = axes * glm::normalize(glm::dvec3(-0.25, 0.5, 1.0));
    return test::SurfacePoint{0.25 * local.x - 0.5 * local.y, normal, glm::u8vec3(1, 2, 3)};
  };
  return test::sample_patch({origin, axes, 0.5, 40, 30}, surface, true);
}

TEST(SurfacePick, IsExactOnATiltedPlaneAtGeoreferencedCoordinates) {
  const glm::dvec3 origin(5.0e5, 5.0e6, 300.0);
  const glm::dmat3 axes = test::axes_about({0.3, -0.2, 0.9});
  const Patch patch = tilted_plane(origin, axes);
  const PatchModel model = test::model_of({patch});
  const SurfacePicker picker(model);
  const glm::dvec3 normal = axes * glm::normalize(glm::dvec3(-0.25, 0.5, 1.0));
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int k = 0; k < 200; ++k) {
    const glm::dvec2 uv(39.0 * unit(random), 29.0 * unit(random));
    const glm::dvec3 p =
        patch.origin + axes * glm::dvec3(0.5 * uv, 0.5 * (0.25 * uv.x - 0.5 * uv.y) -
                                                       glm::dot(patch.origin - origin, axes[2]));
    const glm::dvec3 eye = p + 400.0 * normal + 300.0 * axes[0] * (unit(random) - 0.5);
    PickQuery query{
        eye, 0.01 * (p - eye), 100.0 * (1.0 + kDepthError * (2.0 * unit(random) - 1.0)), 0.3, 0,
        {}};
    const auto found = picker.pick(query);
    ASSERT_TRUE(found);
    // Doubles of that size are 1e-9 apart; a few are added.
    EXPECT_LT(glm::distance(found->position, p), 1e-8);
    EXPECT_LT(glm::distance(found->uv, uv), 1e-7);
    EXPECT_NEAR(found->depth, 100.0, 1e-9);
    // A texel of a normal map has 16 bits.
    EXPECT_LT(glm::distance(found->normal, normal), 1e-4);
    EXPECT_EQ(found->colour, glm::u8vec3(1, 2, 3));
    EXPECT_EQ(found->patch, 0U);
  }
}

TEST(SurfacePick, FollowsInstances) {
  PatchModel model = test::model_of({tilted_plane({0, 0, 0}, glm::dmat3(1.0))});
  const PatchModel extent = without_patches(model);
  const Transform far{{5.0e6, 2.0, 3.0}, rotation_about({1, 2, 3}, 70.0), 2.5};
  ASSERT_TRUE(add_instance(model, {0, 1, {}, 0, false}, extent));
  ASSERT_TRUE(add_instance(model, {0, 1, far, 0, false}, extent));
  const glm::dvec3 own = position_of(model.patches[0], 20, 10) + glm::dvec3(0.1, 0.02, 0.015);
  const glm::dvec3 p = moved(far, own);
  const glm::dvec3 eye = moved(far, own + glm::dvec3(3.0, 1.0, 20.0));
  const auto found = SurfacePicker(model).pick({eye, p - eye, 1.0 + kDepthError, 0.01, 1, {}});
  ASSERT_TRUE(found);
  EXPECT_LT(glm::distance(found->position, p), 1e-8);
  EXPECT_EQ(found->patch, 1U);
}

TEST(SurfacePick, FindsNothingWhereNothingIs) {
  const PatchModel model = test::model_of({tilted_plane({0, 0, 0}, glm::dmat3(1.0))});
  const SurfacePicker picker(model);
  const glm::dvec3 eye(5.0, 5.0, 30.0);
  const glm::dvec3 down(0.0, 0.0, -1.0);
  const auto at = picker.pick({eye, down, 31.25, 0.05, 0, {}});  // z is -1.25 there
  ASSERT_TRUE(at);
  // Three cells before it and behind it.
  EXPECT_FALSE(picker.pick({eye, down, at->depth - 1.5, 0.05, 0, {}}));
  EXPECT_FALSE(picker.pick({eye, down, at->depth + 1.5, 0.05, 0, {}}));
  EXPECT_FALSE(picker.pick({eye, down, at->depth, 0.05, 7, {}})) << "no such patch";
  const std::vector<std::uint32_t> others{5, 0};
  EXPECT_TRUE(picker.pick({eye, down, at->depth, 0.05, 7, others}));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double depth : {0.0, -3.0, nan, std::numeric_limits<double>::infinity()})
    EXPECT_FALSE(picker.pick({eye, down, depth, 0.05, 0, {}})) << depth;
  EXPECT_FALSE(picker.pick({eye, {nan, 0, 1}, 30.0, 0.05, 0, {}}));
  EXPECT_FALSE(picker.pick({eye, {0, 0, 0}, 30.0, 0.05, 0, {}}));
}

TEST(SurfacePick, NeverTakesWhatLiesBehindAnEdge) {
  // Patch 0 ends eight cells above patch 1; its splats reach half a cell beyond x = 20.
  const auto level = [](double z) {
    return test::height_field(41, [z](double /*x*/, double /*y*/) { return z; }).patches.front();
  };
  PatchModel model = test::model_of({level(0.0), level(0.0)});
  model.patches[0].origin.z += 8.0;
  model.patches[1].origin.x += 20.0;
  const SurfacePicker picker(model);
  const std::vector<std::uint32_t> others{1};
  // Rays that meet its very edge, or pass it by less than a pixel, with the depth of the edge.
  for (const double beyond : {-1e-2, -1e-9, 0.0, 1e-9, 1e-6, 1e-3, 4e-2}) {
    const PickQuery query{{20.5 + beyond, 0.3, 108.0}, {0.0, 0.0, -1.0}, 100.0, 0.05, 0, others};
    const auto found = picker.pick(query);
    ASSERT_TRUE(found) << beyond;
    EXPECT_EQ(found->patch, 0U);
    EXPECT_NEAR(found->position.z, 8.0, 1e-9) << beyond;
  }
  // Farther from it than anything is drawn.
  EXPECT_FALSE(picker.pick({{23.0, 0.3, 108.0}, {0.0, 0.0, -1.0}, 100.0, 0.05, 0, others}));
  EXPECT_TRUE(picker.pick({{23.0, 0.3, 108.0}, {0.0, 0.0, -1.0}, 108.0, 0.05, 0, others}));
}

/// What a pick may be off what the GPU has drawn.
struct Offsets {
  double largest = 0.0;  ///< world units
  double behind = 0.0;   ///< along the ray
  double across = 0.0;   ///< along the normal, rms
  double normal_degrees = 0.0;
  std::size_t count = 0;
  std::size_t missing = 0;
};

Offsets offsets_of(const SurfacePicker& picker, const std::vector<Seen>& pixels) {
  Offsets offsets;
  double squares = 0.0;
  for (const Seen& seen : pixels) {
    const auto found = picker.pick(seen.query);
    ++offsets.count;
    if (!found) {
      ++offsets.missing;
      continue;
    }
    offsets.largest = std::max(offsets.largest, glm::distance(found->position, seen.drawn));
    offsets.behind = std::max(
        offsets.behind, (found->depth - seen.query.depth) * glm::length(seen.query.direction));
    const double across = glm::dot(found->normal, found->position - seen.drawn);
    squares += across * across;
    offsets.normal_degrees = std::max(
        offsets.normal_degrees,
        glm::degrees(2.0 *
                     std::asin(0.5 * glm::distance(found->normal, glm::normalize(seen.normal)))));
  }
  offsets.across = std::sqrt(squares / static_cast<double>(offsets.count - offsets.missing));
  return offsets;
}

TEST(SurfacePick, OfASphereMeetsWhatIsDrawn) {
  // Overlapping patches, so that borders are splats.
  const PatchModel model = test::sphere_model(
      {.centre = {5.0e5, 5.0e6, 100.0}, .radius = 2.0, .spacing = 0.1, .patches_per_side = 2});
  const SurfacePicker picker(model);
  for (const Interpolation interpolation : {Interpolation::Direct, Interpolation::Corrected}) {
    RenderSettings settings = with_outputs(small_image(model), "onepass");
    settings.interpolation = interpolation;
    const RenderResult drawn = test::must_render(model, settings);
    const std::vector<Seen> pixels = all_seen(settings, drawn.image);
    const Offsets offsets = offsets_of(picker, pixels);
    EXPECT_GT(offsets.count, 3000U);
    EXPECT_EQ(offsets.missing, 0U);
    // Depths are floats, and slopes of splats beside the cells bytes, here of the steepest of a
    // few nodes instead of the whole patch: less than a hundredth of a cell where they end. Beside
    // its middle a pixel of the silhouette is up to 20 times as far away as it is aside.
    const double aside = test::rasteriser_rounding(
        settings, drawn, glm::distance(settings.camera.eye, model.bounds.max));
    EXPECT_LT(offsets.largest, 0.01 * model.spacing + 20.0 * aside);
  }
}

TEST(SurfacePick, OfRaggedSamplesIsWhereCorrectionHasMovedWhatIsDrawn) {
  // Vegetation: each sample has a height of its own, up to two cells from the next, and a quarter
  // of them are missing. Hardly any cell is whole, and splats are corrected onto triangles that are
  // not drawn themselves.
  std::mt19937 random(3);
  PatchModel model = test::height_field(
      41, [&](double /*x*/, double /*y*/) { return 0.5 * static_cast<double>(random() % 5); });
  for (std::int32_t& height : model.patches.front().heights) {
    if (random() % 4 == 0) height = kHole;
  }
  const SurfacePicker picker(model);
  for (const Interpolation interpolation : {Interpolation::Direct, Interpolation::Corrected}) {
    RenderSettings settings = with_outputs(small_image(model, {30.0, 25.0}, 128), "onepass");
    settings.interpolation = interpolation;
    const std::vector<Seen> pixels = all_seen(settings, test::must_render(model, settings).image);
    const Offsets offsets = offsets_of(picker, pixels);
    EXPECT_GT(offsets.count, 5000U);
    EXPECT_EQ(offsets.missing, 0U);
    // Rasterisation moves corners by 1/512 pixel, half a cell being a pixel, and rays meet the
    // steepest triangles at a tenth of that. Without the correction 1 % is off by 0.27 to 1.7
    // cells.
    EXPECT_LT(offsets.largest, 0.01 * model.spacing);
  }
}

TEST(SurfacePick, OfASilhouetteNeverIsTheFarSide) {
  const PatchModel model = test::sphere_model({.centre = {0, 0, 0}, .radius = 2.0, .spacing = 0.1});
  const SurfacePicker picker(model);
  const RenderSettings settings = with_outputs(small_image(model), "onepass");
  const RenderResult drawn = test::must_render(model, settings);
  const std::vector<float>& patches = values(drawn.image, "patch");
  std::size_t silhouettes = 0;
  for (const std::size_t k : covered_pixels(drawn.image)) {
    const std::size_t x = k % settings.width;
    const std::size_t y = k / settings.width;
    if (x == 0 || x + 1 == settings.width || y == 0 || y + 1 == settings.height) continue;
    if (patches[k - 1] * patches[k + 1] * patches[k - settings.width] *
            patches[k + settings.width] >
        0.0F)
      continue;
    ++silhouettes;
    Seen seen = seen_at(settings, drawn.image, k);
    // The pixel's ray, and rays that pass the sphere by up to a pixel, with that pixel's depth.
    for (const double outward : {0.0, 0.001, 0.01, 0.3, 1.0}) {
      const glm::dvec3 away = glm::normalize(seen.drawn);
      PickQuery query = seen.query;
      query.direction += outward * query.pixel / query.depth * away;
      const auto found = picker.pick(query);
      if (!found && outward > 0.0) continue;  // farther from it than splats reach
      ASSERT_TRUE(found);
      // The surface there faces the eye, or is seen edge-on: a facet turns by 0.05, half of that
      // beyond where the sphere is edge-on. A ray that is not the pixel's may miss what is in front
      // there, and meets the patch a cell farther at most.
      const double facing =
          glm::dot(glm::normalize(found->position), glm::normalize(query.direction));
      EXPECT_LT(facing, outward < 0.1 ? 0.025 : 0.025 + 0.05) << outward;
    }
  }
  EXPECT_GT(silhouettes, 100U);
}

class DragonPick : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    const fs::path file =
        fs::path(RELIEF_SOURCE_DIR) / "../shared/data/scans/dragon/dragon_vrip_res4.ply.gz";
    if (!fs::exists(file)) return;
    Progress silent;
    auto read = read_points(file, silent);
    ASSERT_TRUE(read) << read.error().message;
    auto converted = convert(std::move(read->points), {}, silent);
    ASSERT_TRUE(converted) << converted.error().message;
    dragon = new PatchModel(std::move(converted->model));
  }
  static void TearDownTestSuite() {
    delete dragon;
    dragon = nullptr;
  }
  void SetUp() override {
    if (dragon == nullptr)
      GTEST_SKIP() << "needs the Dragon in ../shared/data/scans/dragon beside the checkout";
  }

  /// Some pixels of an image by an engine, chosen at random.
  static std::vector<Seen> seen_by(const RenderSettings& settings, std::size_t count) {
    const RenderResult drawn = test::must_render(*dragon, settings);
    const std::vector<std::size_t> covered = covered_pixels(drawn.image);
    std::mt19937 random(7);
    std::vector<Seen> pixels;
    for (std::size_t n = 0; n < count && !covered.empty(); ++n) {
      const std::size_t k = covered[random() % covered.size()];
      pixels.push_back(seen_at(settings, drawn.image, k));
    }
    return pixels;
  }

  static PatchModel* dragon;
};
PatchModel* DragonPick::dragon = nullptr;

TEST_F(DragonPick, AgreesWithTheRayTracer) {
  const RenderSettings settings = with_outputs(small_image(*dragon, {}, 256), "raytrace");
  const std::vector<Seen> pixels = seen_by(settings, 500);
  const Offsets offsets = offsets_of(SurfacePicker(*dragon), pixels);
  EXPECT_EQ(offsets.count, 500U);
  EXPECT_EQ(offsets.missing, 0U);
  // The same triangles, in double precision. What is compared with is a float of a depth.
  const double distance = glm::distance(settings.camera.eye, settings.camera.target);
  EXPECT_LT(offsets.largest, 1.5 * distance * 6e-8);
}

TEST_F(DragonPick, AgreesWithWhatIsDrawn) {
  const RenderSettings settings = with_outputs(small_image(*dragon, {70.0, 30.0}, 256), "onepass");
  const std::vector<Seen> pixels = seen_by(settings, 500);
  const Offsets offsets = offsets_of(SurfacePicker(*dragon), pixels);
  EXPECT_EQ(offsets.count, 500U);
  EXPECT_EQ(offsets.missing, 0U);
  // Depths are floats, and rasterisation moves vertices by parts of a pixel: by 1/512 at most.
  EXPECT_LT(offsets.largest, pixels.front().query.pixel / 512.0);
  EXPECT_LT(offsets.normal_degrees, 0.1);  // half floats have eleven bits
}

TEST_F(DragonPick, IsOfTheFinestLevelWhereACoarserOneIsDrawn) {
  RenderSettings settings = with_outputs(small_image(*dragon, {70.0, 30.0}, 64), "onepass");
  settings.pixels_per_sample = 16.0;
  const std::vector<Seen> pixels = seen_by(settings, 500);
  const Offsets offsets = offsets_of(SurfacePicker(*dragon), pixels);
  // The coarser level's silhouette reaches beyond the finest here and there, by its error.
  EXPECT_LT(offsets.missing, offsets.count / 100);
  const double pixel = pixels.front().query.pixel;
  EXPECT_GT(offsets.largest, 0.01 * pixel) << "is a coarser level drawn?";
  // Levels are chosen for an error of 16/128 of a pixel (rms over a patch); of 500 pixels it is 1.3
  // times that, as borders err more.
  EXPECT_LT(offsets.across, 2.0 * 16.0 / 128.0 * pixel);
}

}  // namespace
}  // namespace relief
