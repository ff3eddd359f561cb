// What the engine `surfel` makes of any input: hostile points, cameras, coordinates, threads.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/renderer/engines/surfel/surfel_images.h"

namespace relief {
namespace {

using test::is_same;
using test::must_draw;
using test::plane_cloud;
using test::sphere_cloud;
using test::surfel_image;
using test::values;

void expect_finite(const Image& image) {
  for (const char* const name : {"R", "G", "B", "A", "N.X", "N.Y", "N.Z"}) {
    EXPECT_TRUE(std::ranges::all_of(values(image, name), [](float v) { return std::isfinite(v); }))
        << name;
  }
}

TEST(SurfelInput, PointsThatAreNoneAreLeftOut) {
  SplatCloud cloud = sphere_cloud(2000);
  const RenderSettings settings = surfel_image({0.0, 0.0, 4.0});
  const RenderResult good = must_draw(cloud, settings);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  const auto bad_normal = static_cast<float>(nan);
  test::add_point(cloud, {nan, 0.0, 1.0}, {0.0F, 0.0F, 1.0F}, 0.1);
  test::add_point(cloud, {0.0, infinite, 1.0}, {0.0F, 0.0F, 1.0F}, 0.1);
  test::add_point(cloud, {0.0, 0.0, 2.0}, {bad_normal, 0.0F, 1.0F}, 0.1);
  test::add_point(cloud, {0.0, 0.0, 2.0}, {0.0F, 0.0F, 0.0F}, 0.1);
  test::add_point(cloud, {0.0, 0.0, 2.0}, {0.0F, 0.0F, 1.0F}, 0.0);
  test::add_point(cloud, {0.0, 0.0, 2.0}, {0.0F, 0.0F, 1.0F}, -1.0);
  test::add_point(cloud, {0.0, 0.0, 2.0}, {0.0F, 0.0F, 1.0F}, nan);
  test::add_point(cloud, {0.0, 0.0, 2.0}, {0.0F, 0.0F, 1.0F}, infinite);
  EXPECT_TRUE(is_same(good.image, must_draw(cloud, settings).image));
}

TEST(SurfelInput, NothingGivesAnEmptyImage) {
  EXPECT_EQ(must_draw(SplatCloud(), surfel_image({0.0, 0.0, 4.0})).covered_pixels, 0U);
}

TEST(SurfelInput, DiscsMayBeAnywhereAboutTheEye) {
  // Through the eye's near plane, behind it, edge-on, about it, huge.
  RenderSettings settings = surfel_image({0.0, 0.0, 1.0});
  for (const SurfelBlend blend : {SurfelBlend::Normalised, SurfelBlend::Sorted}) {
    settings.surfel.blend = blend;
    SplatCloud cloud;
    test::add_point(cloud, {0.0, -0.5, 1.0}, {0.0F, 1.0F, 0.0F}, 1e3);
    EXPECT_EQ(must_draw(cloud, settings).covered_pixels, 96U * 48U) << "the lower half";
    test::add_point(cloud, {0.0, 0.0, 3.0}, {0.0F, 0.0F, 1.0F}, 1.0);
    test::add_point(cloud, {0.0, 0.0, 0.0}, {1.0F, 0.0F, 0.0F}, 1.0);
    test::add_point(cloud, {0.0, 0.0, 1.0}, {0.0F, 0.0F, 1.0F}, 1.0);
    test::add_point(cloud, {0.0, 0.0, -1e6}, {0.0F, 0.0F, 1.0F}, 1e12);
    const RenderResult result = must_draw(cloud, settings);
    expect_finite(result.image);
    EXPECT_EQ(result.covered_pixels, 96U * 96U);
  }
}

TEST(SurfelInput, WorldCoordinatesMayBeLarge) {
  // Positions in steps of 2^-20 and a shift of whole numbers, which doubles keep: every difference
  // to the eye is the same.
  SplatCloud cloud = sphere_cloud(3000);
  const auto rounded = [](double value) { return std::round(value * 0x1p20) * 0x1p-20; };
  for (glm::dvec3& p : cloud.positions) p = {rounded(p.x), rounded(p.y), rounded(p.z)};
  RenderSettings settings = surfel_image({1.0, 2.0, 3.0});
  const RenderResult here = must_draw(cloud, settings);
  const glm::dvec3 shift(524288.0, 5242880.0, 1024.0);
  for (glm::dvec3& p : cloud.positions) p += shift;
  settings.camera.eye += shift;
  settings.camera.target += shift;
  EXPECT_TRUE(is_same(here.image, must_draw(cloud, settings).image));
}

TEST(SurfelInput, OrthographicPlanesAreExact) {
  const SplatCloud cloud = plane_cloud(20, 20);
  RenderSettings settings = surfel_image({-3.0, -4.0, 8.0});
  settings.camera.orthographic_height = 10.0;
  settings.count_fragments = true;
  const RenderResult result = must_draw(cloud, settings);
  EXPECT_EQ(result.covered_pixels, 96U * 96U);
  EXPECT_GT(*result.fragments, 96U * 96U);
  const glm::dmat3 rotation = view_rotation(settings.camera);
  const glm::dvec3 forward = glm::transpose(rotation) * glm::dvec3(0.0, 0.0, -1.0);
  for (std::size_t k = 0; k < std::size_t{96} * 96; ++k) {
    const glm::dvec2 offset((static_cast<double>(k % 96) + 0.5) / 9.6 - 5.0,
                            5.0 - (static_cast<double>(k / 96) + 0.5) / 9.6);
    const glm::dvec3 start =
        settings.camera.eye + glm::transpose(rotation) * glm::dvec3(offset, 0.0);
    // Depth values are linear over the model's bounds, 60 units, of which floats keep 4e-6.
    ASSERT_NEAR(values(result.image, "Z")[k], -start.z / forward.z, 1e-3);
  }
}

TEST(SurfelInput, ThreadsChangeNothing) {
  const SplatCloud cloud = sphere_cloud(20000);
  for (const SurfelBlend blend : {SurfelBlend::Normalised, SurfelBlend::Sorted}) {
    RenderSettings settings = surfel_image({1.0, 2.0, 3.0});
    settings.surfel.blend = blend;
    settings.material = Material::Lit;
    const RenderResult many = must_draw(cloud, settings);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_TRUE(is_same(many.image, must_draw(cloud, settings).image));
  }
}

TEST(SurfelInput, SamplesPerPixelAreMeans) {
  const SplatCloud cloud = sphere_cloud(3000);
  RenderSettings settings = surfel_image({0.0, 0.0, 4.0});
  settings.outputs = {};
  settings.samples = 4;
  const RenderResult result = must_draw(cloud, settings);
  const std::vector<float>& alpha = values(result.image, "A");
  EXPECT_TRUE(std::ranges::any_of(alpha, [](float a) { return a > 0.0F && a < 1.0F; }));
}

TEST(SurfelInput, FrameNamesItsPasses) {
  RenderSettings settings = surfel_image({0.0, 0.0, 4.0});
  settings.explain = true;
  const RenderResult result = must_draw(sphere_cloud(500), settings);
  ASSERT_TRUE(result.explanation);
  std::vector<std::string> names;
  names = result.explanation->passes;
  EXPECT_EQ(names, (std::vector<std::string>{"visibility", "accumulation", "shading"}));
}

}  // namespace
}  // namespace relief
