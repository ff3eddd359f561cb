// What the engine `ewa` makes of points that are no surface, of threads and of materials.
#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <limits>

#include "tests/renderer/engines/ewa/ewa_clouds.h"
#include "tests/renderer/images.h"

namespace relief {
namespace {

using test::add_point;
using test::ewa_image;
using test::must_splat;
using test::values;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Every value of every channel is finite, but depths where nothing is seen.
void expect_numbers(const RenderResult& result) {
  for (const Channel& channel : result.image.channels) {
    for (std::size_t k = 0; k < channel.values.size(); ++k) {
      const float value = channel.values[k];
      const bool empty = channel.name == "Z" && values(result.image, "A")[k] == 0.0F;
      ASSERT_TRUE(empty ? value == std::numeric_limits<float>::infinity() : std::isfinite(value))
          << channel.name << ' ' << k << ' ' << value;
    }
  }
}

void expect_same_image(const Image& a, const Image& b) {
  ASSERT_EQ(a.channels.size(), b.channels.size());
  for (std::size_t c = 0; c < a.channels.size(); ++c)
    EXPECT_EQ(a.channels[c].values, b.channels[c].values) << a.channels[c].name;
}

const std::vector<EwaFilter> kInputFilters{EwaFilter::Ewa, EwaFilter::SourceSpace,
                                           EwaFilter::Circular, EwaFilter::Unfiltered};

TEST(EwaInput, PointsWithoutSurfaceChangeNothing) {
  const SplatCloud plane = test::plane_cloud(12, 4);
  SplatCloud cloud = plane;
  const glm::vec3 up(0.0F, 0.0F, 1.0F);
  const glm::dvec3 eye(0.0, 0.0, 20.0);
  const double nan = std::nan("");
  add_point(cloud, {8, 0, 0}, glm::vec3(0.0F), 1.0);               // no normal
  add_point(cloud, {8, 0, 0}, glm::vec3(std::nanf("")), 1.0);      //
  add_point(cloud, {8, 0, 0}, up, 0.0);                            // no radius
  add_point(cloud, {8, 0, 0}, up, -1.0);                           //
  add_point(cloud, {8, 0, 0}, up, nan);                            //
  add_point(cloud, {8, 0, 0}, up, 1e-300);                         //
  add_point(cloud, {nan, 0, 0}, up, 1.0);                          // no position
  add_point(cloud, {kInfinity, 0, 0}, up, 1.0);                    //
  add_point(cloud, {0, 0, 1e308}, up, 1.0);                        // behind the eye
  add_point(cloud, {3, 1, 25}, up, 1.0);                           //
  add_point(cloud, {3, 1, 25}, up, 1e30);                          //
  add_point(cloud, eye, up, 1.0);                                  // at the eye
  add_point(cloud, eye + glm::dvec3(5, 0, 0), up, 1.0);            // on the eye plane
  add_point(cloud, eye + glm::dvec3(5, 0, -0.2), {1, 0, 1}, 1.0);  // beside the image
  add_point(cloud, {8, 0, 0}, glm::cross(glm::vec3(8, 0, -20), {0, 1, 0}), 0.0);
  add_point(cloud, {0, 6, 0}, {0.0F, 20.0F, 6.0F}, 1.0);  // edge-on
  for (const EwaFilter filter : kInputFilters) {
    RenderSettings settings = ewa_image(eye, 48);
    settings.ewa.filter = filter;
    const RenderResult with = must_splat(cloud, settings);
    expect_numbers(with);
    expect_same_image(with.image, must_splat(plane, settings).image);
  }
}

TEST(EwaInput, HugeSplatsFillTheImageAndNothingMore) {
  for (const double radius : {1e3, 1e30, 1e300}) {
    SplatCloud cloud;
    add_point(cloud, {0.5, 0.2, 0.0}, {0.3F, 0.2F, 1.0F}, radius);
    for (const EwaFilter filter : kInputFilters) {
      RenderSettings settings = ewa_image({0.0, 0.0, 5.0}, 24);
      settings.ewa.filter = filter;
      const RenderResult result = must_splat(cloud, settings);
      expect_numbers(result);
      EXPECT_EQ(result.covered_pixels, 24U * 24U) << radius;
    }
  }
}

TEST(EwaInput, TiltedSplatsAreNumbersAtEveryAngle) {
  SplatCloud cloud;
  for (int k = 0; k <= 2000; ++k) {
    const double angle = k * std::numbers::pi / 2000.0;
    const double along = 0.01 * (k - 1000);
    add_point(cloud, {along, 0.37 * along, 0.1 * along},
              glm::vec3(std::sin(angle), 0.0, std::cos(angle)), k % 7 == 0 ? 20.0 : 0.3,
              {1.0F, 1.0F, 1.0F, 0.01F * static_cast<float>(k % 101)});
  }
  for (const EwaFilter filter : kInputFilters) {
    for (const int layers : {1, 2, 4}) {
      RenderSettings settings = ewa_image({0.0, 0.0, 12.0}, 48);
      settings.ewa.filter = filter;
      settings.ewa.layers = layers;
      settings.material = Material::Lit;
      expect_numbers(must_splat(cloud, settings));
    }
  }
}

TEST(EwaInput, UndefinedAttributesStayOutOfTheImage) {
  SplatCloud cloud = test::plane_cloud(4, 4);
  cloud.colours[40] = glm::vec4(std::nanf(""), 1.0F, std::numeric_limits<float>::infinity(), 7.0F);
  cloud.uvs.assign(cloud.positions.size(), glm::vec2(std::nanf("")));
  expect_numbers(must_splat(cloud, ewa_image({0.0, 0.0, 12.0}, 32)));
}

TEST(EwaInput, BackToBackNormalsAreShadedAsFacingTheEye) {
  SplatCloud cloud;
  add_point(cloud, {0, 0, 0}, {0, 0, 1}, 2.0);
  add_point(cloud, {0, 0, 0}, {0, 0, -1}, 2.0);
  RenderSettings settings = ewa_image({0.0, 0.0, 8.0}, 16);
  settings.material = Material::Lit;
  const RenderResult result = must_splat(cloud, settings);
  expect_numbers(result);
  EXPECT_GT(values(result.image, "R")[8 * 16 + 8], 0.1F);
}

TEST(EwaInput, EmptyCloudIsAnEmptyImage) {
  RenderSettings settings = ewa_image({0.0, 0.0, 8.0}, 16);
  for (const double budget : {0.0, 1.0}) {
    settings.ewa.time_budget_ms = budget;
    const RenderResult result = must_splat({}, settings);
    expect_numbers(result);
    EXPECT_EQ(result.covered_pixels, 0U);
    EXPECT_EQ(result.fragments, 0U);
  }
}

TEST(EwaInput, ThreadsDoNotChangeTheImage) {
  SplatCloud cloud = test::sphere_cloud(40000);  // three pieces of work, 16 tiles
  for (std::size_t k = 0; k < cloud.colours.size(); ++k) cloud.colours[k].a = 0.3F;
  RenderSettings settings = ewa_image({0.0, 0.5, 2.5}, 128);
  settings.ewa.layers = 2;
  settings.material = Material::Lit;
  const RenderResult reference = must_splat(cloud, settings);
  for (const std::size_t threads : {1, 2, 7}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const RenderResult result = must_splat(cloud, settings);
    expect_same_image(result.image, reference.image);
    EXPECT_EQ(result.fragments, reference.fragments);
  }
}

TEST(EwaInput, MaterialsAreChosenByIndex) {
  SplatCloud cloud = test::plane_cloud(20, 20);
  for (const glm::dvec3& p : cloud.positions) cloud.materials.push_back(p.x < 0.0 ? 0 : 1);
  RenderSettings settings = ewa_image({0.0, 0.0, 20.0}, 32);
  settings.materials = {{Material::Unlit, {}}, {Material::Lit, {}}};
  const RenderResult result = must_splat(cloud, settings);
  settings.materials = {{Material::Lit, {}}};
  cloud.materials.clear();
  const RenderResult lit = must_splat(cloud, settings);
  const std::size_t left = 16 * 32 + 6;
  const std::size_t right = 16 * 32 + 26;
  EXPECT_NEAR(values(result.image, "R")[left], 0.5F, 1e-6);
  EXPECT_EQ(values(result.image, "R")[right], values(lit.image, "R")[right]);
  EXPECT_GT(std::abs(values(lit.image, "R")[left] - 0.5F), 0.01F);
}

TEST(EwaInput, GeoreferencedCoordinatesDoNotShake) {
  const SplatCloud near = test::sphere_cloud(5000);
  SplatCloud far = near;
  const glm::dvec3 offset(4.5e6, 5.2e6, -300.0);
  for (glm::dvec3& p : far.positions) p += offset;
  RenderSettings settings = ewa_image({0.3, 0.5, 3.0}, 64);
  const RenderResult here = must_splat(near, settings);
  settings.camera.eye += offset;
  settings.camera.target += offset;
  const RenderResult there = must_splat(far, settings);
  // Doubles keep 1e-9 at 5e6: a pixel, 0.03 units, is kept to 3e-8.
  for (std::size_t k = 0; k < std::size_t{64} * 64; ++k) {
    EXPECT_NEAR(values(there.image, "G")[k], values(here.image, "G")[k], 1e-5);
    EXPECT_NEAR(values(there.image, "A")[k], values(here.image, "A")[k], 1e-5);
  }
}

}  // namespace
}  // namespace relief
