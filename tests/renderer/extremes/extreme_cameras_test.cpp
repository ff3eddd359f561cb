// Cameras that are very near, far away, grazing and inside: no engine may leave a hole in what is
// surely seen, nor a value that is not a number.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/renderer/view/orthographic.h"

namespace relief {
namespace {

using test::EngineMethod;
using test::must_render;
using test::values;

/// Every channel's values that are not finite. Depth is infinite where nothing is seen.
std::size_t count_not_finite(const Image& image) {
  const std::vector<float>& alpha = values(image, "A");
  std::size_t count = 0;
  for (const Channel& channel : image.channels) {
    for (std::size_t k = 0; k < channel.values.size(); ++k) {
      const float v = channel.values[k];
      const bool is_nothing = channel.name == "Z" && std::isinf(v) && v > 0.0F && alpha[k] < 1.0F;
      count += std::isfinite(v) || is_nothing ? 0 : 1;
    }
  }
  return count;
}

RenderSettings seen_from(const EngineMethod& method, const PatchModel& model, glm::dvec3 eye,
                         glm::dvec3 target, glm::dvec3 up) {
  RenderSettings settings = test::by(method, test::small_image(model));
  settings.count_fragments = false;
  settings.width = 60;
  settings.height = 48;
  settings.camera = {eye, target, up, 45.0};
  return settings;
}

class ExtremeCameras : public testing::TestWithParam<EngineMethod> {};

// With a near plane at a hundredth of a spacing, and splats of `ewa` cut to the eye's distance,
// nothing was seen from a hundredth of a spacing on.
TEST_P(ExtremeCameras, NextToASurfaceSeeItEverywhere) {
  const PatchModel model = test::height_field(33, [](double, double) { return 0.0; });
  for (const double height : {1.0, 1e-2, 1e-4, 1e-5}) {
    // A splat's image is affine about its centre: nearer than this `ewa` loses the splats beside.
    if (GetParam().engine == "ewa" && height < 1e-2) continue;
    const RenderSettings settings =
        seen_from(GetParam(), model, {0.3, 0.4, height}, {0.3, 0.4, 0.0}, {0.0, 1.0, 0.0});
    const RenderResult result = must_render(model, settings);
    EXPECT_EQ(count_not_finite(result.image), 0U) << height;
    EXPECT_EQ(result.covered_pixels, 60U * 48U) << height;
  }
}

TEST_P(ExtremeCameras, GiveFiniteValuesFromAnywhere) {
  const PatchModel model = test::sphere_model({.spacing = 0.1, .bumps = 0.05});
  const std::array<glm::dvec3, 7> eyes{{{0.0, 0.0, 0.0},         // inside
                                        {0.0, 0.0, 1.0},         // in the surface
                                        {0.0, 0.05, 0.999},      // through it
                                        {0.0, 0.0, 1.0 + 1e-7},  // on it
                                        {0.0, 0.0, 1e3},
                                        {0.0, 0.0, 1e6},
                                        {0.0, 0.0, 1e12}}};
  for (const glm::dvec3& eye : eyes) {
    const glm::dvec3 target = eye.z > 0.5 ? glm::dvec3(0.0) : glm::dvec3(1.0, 0.2, 0.1);
    for (const double degrees : {0.01, 45.0, 175.0}) {
      RenderSettings settings = seen_from(GetParam(), model, eye, target, {0.0, 1.0, 0.0});
      settings.camera.vertical_fov_degrees = degrees;
      const RenderResult result = must_render(model, settings);
      EXPECT_EQ(count_not_finite(result.image), 0U) << eye.z << ' ' << degrees;
    }
  }
}

TEST_P(ExtremeCameras, SeeAPlaneAlongItselfWithoutInfinities) {
  const PatchModel model = test::height_field(33, [](double, double) { return 0.0; });
  for (const double degrees : {89.0, 89.99, 89.999999, 90.0}) {
    const double angle = degrees * std::acos(-1.0) / 180.0;
    const glm::dvec3 eye = 40.0 * glm::dvec3(std::sin(angle), 0.0, std::cos(angle));
    const RenderResult result =
        must_render(model, seen_from(GetParam(), model, eye, {0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}));
    EXPECT_EQ(count_not_finite(result.image), 0U) << degrees;
  }
}

TEST_P(ExtremeCameras, DrawImagesOfAnyShape) {
  const PatchModel model = test::sphere_model({.spacing = 0.1});
  for (const auto& [width, height] :
       {std::pair{1U, 1U}, std::pair{1U, 101U}, std::pair{101U, 1U}, std::pair{3U, 201U}}) {
    RenderSettings settings =
        seen_from(GetParam(), model, {0.0, 0.0, 3.0}, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0});
    settings.width = width;
    settings.height = height;
    const RenderResult result = must_render(model, settings);
    EXPECT_EQ(count_not_finite(result.image), 0U) << width << 'x' << height;
    EXPECT_GT(result.covered_pixels, 0U) << width << 'x' << height;
  }
}

INSTANTIATE_TEST_SUITE_P(All, ExtremeCameras, testing::ValuesIn(test::all_engine_methods()),
                         test::name_of_method);

}  // namespace
}  // namespace relief
