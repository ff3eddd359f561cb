// What is seen from behind is shaded as the front of a surface that faces the eye.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/renderer/scenes.h"
#include "tests/renderer/view/orthographic.h"

namespace relief::test {
namespace {

/// A level square whose patch faces up, or down.
PatchModel level_square(bool faces_down) {
  PatchModel model = height_field(33, [](double /*x*/, double /*y*/) { return 0.0; });
  if (!faces_down) return model;
  const double side = (model.patches.front().width - 1) * model.patches.front().spacing;
  for (Patch& patch : model.patches) {
    patch.origin += side * patch.axes[1];
    patch.axes = {patch.axes[0], -patch.axes[1], -patch.axes[2]};
  }
  return model;
}

class BackSide : public testing::TestWithParam<EngineMethod> {};

// The eye below sees the back of the square that faces up, at angles at which a normal alone could
// be that of a contour.
TEST_P(BackSide, IsShadedAsAFrontThere) {
  const PatchModel up = level_square(false);
  const PatchModel down = level_square(true);
  for (const double degrees : {10.0, 20.0, 30.0}) {
    RenderSettings settings = by(GetParam(), small_image(up, {0.0, 0.0}));
    const double angle = degrees * std::numbers::pi / 180.0;
    const glm::dvec3 middle = (up.bounds.min + up.bounds.max) / 2.0;
    const double distance = 2.5 * up.bounding_radius;
    settings.camera.target = middle;
    settings.camera.eye = middle + distance * glm::dvec3(0.0, -std::cos(angle), -std::sin(angle));
    settings.camera.up = {0.0, 0.0, 1.0};
    const Image from_behind = must_render(up, settings).image;
    const Image from_front = must_render(down, settings).image;
    std::size_t covered = 0;
    for (std::size_t k = 0; k < values(from_behind, "A").size(); ++k) {
      if (values(from_behind, "A")[k] < 1.0F || values(from_front, "A")[k] < 1.0F) continue;
      ++covered;
      // Half floats, and normals of 16 bits.
      ASSERT_NEAR(values(from_behind, "R")[k], values(from_front, "R")[k], 2e-3)
          << degrees << " degrees, pixel " << k;
    }
    EXPECT_GT(covered, 500U) << degrees;
  }
}

std::vector<EngineMethod> methods_that_know_the_side() {
  std::vector<EngineMethod> methods;
  for (const EngineMethod& method : all_engine_methods()) {
    for (const char* engine : {"onepass", "raytrace", "ewa"})
      if (method.engine == engine) methods.push_back(method);
  }
  return methods;
}

INSTANTIATE_TEST_SUITE_P(All, BackSide, testing::ValuesIn(methods_that_know_the_side()),
                         name_of_method);

}  // namespace
}  // namespace relief::test
