// What cells draw, against the same surface drawn otherwise.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <random>

#include "renderer/engines/onepass/visibility.h"
#include "shaders/include/shared.h"
#include "tests/renderer/images.h"

namespace relief {
namespace {

using test::must_render;
using test::small_image;
using test::values;

/// Waves with a hole in them, rough by `roughness` cells, seen so that some hide some.
PatchModel wavy_field(double roughness) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> noise(-roughness, roughness);
  PatchModel model = test::height_field(40, [&](double x, double y) {
    return 1.2 * std::sin(0.5 * x) * std::cos(0.6 * y) + noise(random);
  });
  Patch& patch = model.patches[0];
  patch.normals = {};  // those of the heights, not of noise that never stood anywhere
  for (const std::uint32_t j : {17U, 18U, 19U}) {
    for (const std::uint32_t i : {21U, 22U})
      patch.heights[std::size_t{j} * patch.width + i] = kHole;
  }
  return model;
}

RenderSettings seen_from_above(const PatchModel& model) {
  RenderSettings settings = small_image(model);
  settings.camera = {{12.0, -9.0, 22.0}, {0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, 50.0};
  settings.outputs = test::all_outputs();
  settings.primitive = Primitive::Cell;
  return settings;
}

TEST(CellImages, MatchThePatchTriangles) {
  const PatchModel model = wavy_field(0.1);
  RenderSettings settings = seen_from_above(model);
  const RenderResult cells = must_render(model, settings);
  settings.engine = "raytrace";
  settings.raytrace.samples = 1;
  const RenderResult rays = must_render(model, settings);
  std::size_t hit = 0;
  std::size_t other = 0;
  for (std::size_t k = 0; k < values(rays.image, "Z").size(); ++k) {
    if (values(rays.image, "patch")[k] == 0.0F) continue;
    ++hit;
    // OpenGL moves corners by up to 1/512 pixel, which is 0.25 cells here, more along a slope that
    // is seen at a low angle; the rest is rounding of single precision.
    const double u = values(rays.image, "UV.U")[k] - values(cells.image, "UV.U")[k];
    const double v = values(rays.image, "UV.V")[k] - values(cells.image, "UV.V")[k];
    const double depth = values(rays.image, "Z")[k] - values(cells.image, "Z")[k];
    other += std::hypot(u, v) < 0.004 && std::abs(depth) < 0.004 ? 0 : 1;
  }
  EXPECT_GT(hit, 5000U);
  // Beyond that there are pixels in which a border splat, or the other side of an edge that hides
  // something, is in front: the rims of the patch, of the hole and of the hills.
  EXPECT_LT(other, hit / 50);
}

TEST(CellImages, OfAPlaneAreThoseOfQuads) {
  const PatchModel model =
      test::height_field(50, [](double x, double y) { return 0.4 * x - 0.3 * y; });
  RenderSettings settings = seen_from_above(model);
  const RenderResult cells = must_render(model, settings);
  settings.primitive = Primitive::Quad;
  const RenderResult quads = must_render(model, settings);
  std::size_t covered = 0;
  std::size_t beyond = 0;
  const double last = model.patches[0].width - 1.0;
  for (std::size_t k = 0; k < values(cells.image, "Z").size(); ++k) {
    if (values(cells.image, "patch")[k] != values(quads.image, "patch")[k]) {
      // Beyond the outermost samples: quads are margins wider, and have corners where the curve
      // that cells are cut off along is round.
      EXPECT_EQ(values(cells.image, "patch")[k], 0.0F);
      const double u = values(quads.image, "UV.U")[k];
      const double v = values(quads.image, "UV.V")[k];
      EXPECT_EQ(std::min({u, v, last - u, last - v}), 0.0) << u << " " << v;
      ++beyond;
      continue;
    }
    if (values(cells.image, "patch")[k] == 0.0F) continue;
    ++covered;
    // A cell's plane and a quad's differ by the rounding of slopes, half a step of 1/127 of the
    // steepest, over half a cell. Where quads meet a GPU may show the farther one: over a cell.
    const double rounding = test::drawn_by_gpu(quads) ? 0.008 : 0.004;
    EXPECT_NEAR(values(cells.image, "Z")[k], values(quads.image, "Z")[k], rounding);
    EXPECT_NEAR(values(cells.image, "UV.U")[k], values(quads.image, "UV.U")[k], 0.006);
    EXPECT_NEAR(values(cells.image, "N.Z")[k], values(quads.image, "N.Z")[k], 0.001);
  }
  EXPECT_GT(covered, 5000U);
  EXPECT_LT(beyond, covered / 200);
}

TEST(CellImages, ShadeFewerFragmentsThanQuads) {
  test::SphereShape shape;
  shape.bumps = 0.08;
  const PatchModel model = test::sphere_model(shape);
  RenderSettings settings = small_image(model);
  settings.primitive = Primitive::Quad;
  const RenderResult quads = must_render(model, settings);
  settings.primitive = Primitive::Cell;
  const RenderResult cells = must_render(model, settings);
  ASSERT_TRUE(cells.fragments && quads.fragments);
  // Those that find the surface and those that shade it, each pixel once.
  EXPECT_LT(*cells.fragments - cells.covered_pixels, *quads.fragments);
}

TEST(CellImages, DeferredShadingShowsTheSameSurface) {
  const PatchModel model = wavy_field(0.1);
  for (const double pixels_per_sample : {0.0, 30.0}) {  // 30: a coarser level, cut by the mask
    RenderSettings settings = seen_from_above(model);
    settings.pixels_per_sample = pixels_per_sample;
    settings.material = Material::Unlit;  // shaded as it is found
    const RenderResult at_once = must_render(model, settings);
    settings.material = Material::Lit;
    const RenderResult later = must_render(model, settings);
    for (const char* channel : {"A", "Z", "patch"})
      EXPECT_EQ(values(at_once.image, channel), values(later.image, channel)) << channel;
    ASSERT_TRUE(at_once.fragments && later.fragments);
    EXPECT_EQ(*later.fragments, *at_once.fragments + later.covered_pixels);
    std::size_t covered = 0;
    for (std::size_t k = 0; k < values(later.image, "A").size(); ++k) {
      if (values(later.image, "patch")[k] == 0.0F) continue;
      ++covered;
      for (const char* channel : {"UV.U", "UV.V"}) {
        // Places are rounded down to 1/8192 of a cell, of a level's of up to eight; then to floats.
        EXPECT_NEAR(values(later.image, channel)[k], values(at_once.image, channel)[k], 8.1 / 8192);
      }
    }
    EXPECT_GT(covered, 2000U);
  }
}

TEST(CellImages, StoreGridCoordinatesAtFullPrecision) {
  EXPECT_EQ(onepass::position_steps(1), 262144.0F);  // 2^22 over 9 cells
  EXPECT_EQ(onepass::position_steps(503), 8192.0F);  // 511 cells
  EXPECT_EQ(onepass::position_steps(504), 4096.0F);  // 512 cells would need the step 2^22
  EXPECT_EQ(onepass::position_steps(kMaxPatchSide), 128.0F);
}

TEST(CellImages, OfAPatchLargerThanAPartHaveNoSeam) {
  // The eye looks at where four parts meet, from so near that a culled one would be missed.
  const PatchModel model = test::height_field(
      300, [](double x, double y) { return 2.0 * std::sin(0.3 * x) * std::cos(0.25 * y); });
  const double middle = 5 * shared::kPartCells - 149.5;
  for (const double elevation : {90.0, 45.0}) {
    RenderSettings settings = small_image(model);
    const double e = glm::radians(elevation);
    const glm::dvec3 target(middle, middle, 0.0);
    settings.camera = {
        target + 25.0 * glm::dvec3(0.0, -std::cos(e), std::sin(e)), target, {0.0, 1.0, 0.1}, 40.0};
    settings.primitive = Primitive::Cell;
    const RenderResult result = must_render(model, settings);
    EXPECT_EQ(result.covered_pixels, std::uint64_t{settings.width} * settings.height) << elevation;
  }
}

TEST(CellImages, InterpolationAffectsOnlySplats) {
  // A ridge between columns 19 and 20 of a surface that is smooth elsewhere.
  const PatchModel model =
      test::height_field(40, [](double x, double y) { return 0.1 * y - 0.9 * std::abs(x); });
  RenderSettings settings = seen_from_above(model);
  const RenderResult corrected = must_render(model, settings);
  settings.interpolation = Interpolation::Direct;
  const RenderResult direct = must_render(model, settings);
  std::size_t different = 0;
  for (std::size_t k = 0; k < values(direct.image, "Z").size(); ++k) {
    if (values(direct.image, "Z")[k] == values(corrected.image, "Z")[k]) continue;
    ++different;
    // A splat begins at a sample beside the ridge and ends a cell and its margin from there.
    EXPECT_LE(std::abs(values(direct.image, "UV.U")[k] - 19.5), 2.0);
  }
  EXPECT_GT(different, 0U);
}

}  // namespace
}  // namespace relief
