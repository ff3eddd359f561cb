// What orthographic images have in common with perspective ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "common/compare/compare.h"
#include "tests/renderer/view/orthographic.h"

namespace relief {
namespace {

using test::by;
using test::EngineMethod;
using test::must_render;
using test::values;

PatchModel bumpy_sphere() {
  test::SphereShape shape;
  shape.bumps = 0.05;
  return test::sphere_model(shape);
}

RenderSettings orthographic_image(const PatchModel& model, const EngineMethod& method) {
  RenderSettings settings = by(method, test::small_image(model, {25.0, 20.0}));
  settings.camera.orthographic_height = 2.4;
  return settings;
}

/// A perspective camera so many radii away that sees as much across the sphere's middle.
Camera seen_from(Camera camera, double distance) {
  const double height = camera.orthographic_height;
  camera.eye = camera.target - distance * test::forward(camera);
  camera.vertical_fov_degrees = 2.0 * std::atan(0.5 * height / distance) * 180.0 / std::acos(-1.0);
  camera.orthographic_height = 0.0;
  return camera;
}

/// Rms difference of colours (linear) where both images are covered and neither is within a few
/// cells of the rim.
double colour_difference(const Image& a, const Image& b) {
  double squared = 0.0;
  std::size_t count = 0;
  for (std::size_t k = 0; k < values(a, "A").size(); ++k) {
    const double x = static_cast<double>(k % a.width) + 0.5 - 0.5 * a.width;
    const double y = static_cast<double>(k / a.width) + 0.5 - 0.5 * a.height;
    if (std::hypot(x, y) > 0.3 * a.height) continue;
    ++count;
    const double off = values(a, "R")[k] - values(b, "R")[k];
    squared += off * off;
  }
  return std::sqrt(squared / static_cast<double>(count));
}

class OrthographicLimits : public testing::TestWithParam<EngineMethod> {};

TEST_P(OrthographicLimits, AreWhatPerspectiveBecomesFarAway) {
  const PatchModel model = bumpy_sphere();
  RenderSettings settings = orthographic_image(model, GetParam());
  const Camera orthographic = settings.camera;
  const Image limit = must_render(model, settings).image;
  std::vector<double> differences;
  for (const double distance : {10.0, 100.0, 1000.0}) {
    settings.camera = seen_from(orthographic, distance);
    differences.push_back(colour_difference(must_render(model, settings).image, limit));
  }
  // Rays lean by the inverse of the distance, and positions move by as much. Below 0.003, which is
  // 50 dB, another splat in front here and there is more than that; half floats alone are 3e-4.
  EXPECT_GT(differences[0], 5.0 * differences[1]);
  EXPECT_LT(differences[2], std::max(differences[1] / 3.0, 0.003));
  EXPECT_LT(differences[2], 0.003);
}

TEST_P(OrthographicLimits, DoNotDependOnTheEyesDistance) {
  const PatchModel model = bumpy_sphere();
  RenderSettings settings = orthographic_image(model, GetParam());
  const Image near = must_render(model, settings).image;
  const double farther = 1e5;
  settings.camera.eye -= farther * test::forward(settings.camera);
  const Image far = must_render(model, settings).image;
  // A splat or an edge here and there falls the other way: positions were rounded relative to
  // another eye.
  EXPECT_LE(test::count_different(near, far, 1), values(near, "A").size() / 500);
  for (std::size_t k = 0; k < values(near, "Z").size(); ++k) {
    if (!std::isfinite(values(near, "Z")[k]) || !std::isfinite(values(far, "Z")[k])) continue;
    // Single precision has steps of 1/128 there. A tenth is another sheet of the same splats.
    ASSERT_NEAR(values(far, "Z")[k] - farther, values(near, "Z")[k], 0.1) << k;
  }
}

TEST_P(OrthographicLimits, AreAsRightAsPerspectiveOnes) {
  const PatchModel model = bumpy_sphere();
  const EngineMethod truth{"raytrace", Primitive::Cell, Interpolation::Corrected, ""};
  const auto compared_to_truth = [&](const Camera& camera) {
    RenderSettings settings = orthographic_image(model, GetParam());
    RenderSettings traced = orthographic_image(model, truth);
    settings.camera = traced.camera = camera;
    Progress silent;
    return compare_images(must_render(model, settings).image, must_render(model, traced).image, {},
                          silent);
  };
  const Camera camera = orthographic_image(model, GetParam()).camera;
  const auto orthographic = compared_to_truth(camera);
  const auto perspective = compared_to_truth(seen_from(camera, 2.6));
  ASSERT_TRUE(orthographic && perspective);
  EXPECT_EQ(orthographic->coverage->holes, 0U);
  // Both images show the sphere as large, but other parts of it, which may differ by 1.5 dB. Above
  // 60 dB a few pixels decide: those that show the other one of two overlapping patches.
  EXPECT_GE(*orthographic->psnr_covered_db, std::min(*perspective->psnr_covered_db - 1.5, 60.0));
}

INSTANTIATE_TEST_SUITE_P(All, OrthographicLimits, testing::ValuesIn(test::all_engine_methods()),
                         test::name_of_method);

}  // namespace
}  // namespace relief
