// Where the engine `surfel` puts surfaces: discs, planes, spheres; blending and offsets.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "renderer/geometry/splats_of_samples.h"
#include "tests/renderer/engines/surfel/surfel_images.h"

namespace relief {
namespace {

using test::is_same;
using test::must_draw;
using test::pixel_ray;
using test::plane_cloud;
using test::sphere_cloud;
using test::surfel_image;
using test::values;

constexpr glm::vec4 kRed(1.0F, 0.0F, 0.0F, 1.0F);
constexpr glm::vec4 kGreen(0.0F, 1.0F, 0.0F, 1.0F);

/// How far the ray of a pixel passes the origin.
double miss_of(const RenderSettings& settings, std::size_t pixel) {
  const glm::dvec3 ray =
      glm::normalize(pixel_ray(settings, pixel % settings.width, pixel / settings.width));
  const glm::dvec3 toward = -settings.camera.eye;
  return glm::length(toward - glm::dot(toward, ray) * ray);
}

TEST(SurfelSurface, DiscIsSeenInPerspective) {
  // One disc of radius 1, seen at 30 degrees over its plane from 3 away: far from affine.
  SplatCloud cloud;
  test::add_point(cloud, {0.0, 0.0, 0.0}, {0.0F, 0.0F, 1.0F}, 1.0);
  for (const int sides : {3, 4, 8, 64}) {
    RenderSettings settings = surfel_image({0.0, -2.6, 1.5}, 192);
    settings.surfel.sides = sides;
    const RenderResult result = must_draw(cloud, settings);
    std::size_t within = 0;
    for (std::size_t k = 0; k < std::size_t{192} * 192; ++k) {
      const glm::dvec3 ray = pixel_ray(settings, k % 192, k / 192);
      const double depth = -settings.camera.eye.z / ray.z;
      const double distance = glm::length(settings.camera.eye + depth * ray);
      const bool hit = depth > 0.0 && distance <= 1.0;
      // Where the rim passes a pixel's middle by a thousandth of the radius, rounding decides.
      if (std::abs(distance - 1.0) < 1e-3) continue;
      ASSERT_EQ(values(result.image, "A")[k], hit ? 1.0F : 0.0F) << sides << ' ' << k;
      if (!hit) continue;
      ++within;
      // Depth is interpolated between corners that are snapped to 1/256 pixel: 4e-5 of 3 units a
      // pixel at this slope.
      ASSERT_NEAR(values(result.image, "Z")[k], depth, 1e-3);
      // Half floats, to which llvmpipe cuts off.
      ASSERT_NEAR(values(result.image, "N.Z")[k], 1.0F, 5e-4);
    }
    EXPECT_GT(within, 1000U);
  }
}

TEST(SurfelSurface, SphereIsWholeAndOfOneColour) {
  SplatCloud cloud = sphere_cloud(3000);
  // The weights must cancel.
  std::fill(cloud.colours.begin(), cloud.colours.end(), glm::vec4(0.75F, 0.5F, 0.125F, 1.0F));
  const double radius = cloud.radii.front();
  for (const glm::dvec3 eye :
       {glm::dvec3(0, 0, 4), glm::dvec3(3, -2, 1), glm::dvec3(0, 1.3, 0.1)}) {
    for (const SurfelBlend blend : {SurfelBlend::Normalised, SurfelBlend::Sorted}) {
      RenderSettings settings = surfel_image(eye);
      settings.surfel.blend = blend;
      if (eye.z == 0.1) settings.camera.up = {0.0, 0.0, 1.0};
      const RenderResult result = must_draw(cloud, settings);
      for (std::size_t k = 0; k < std::size_t{96} * 96; ++k) {
        const double miss = miss_of(settings, k);
        const float alpha = values(result.image, "A")[k];
        // Discs end inside of the sphere's contour by what their chords cut off, radius^2 / 2, and
        // outside of it by as much.
        if (miss < 1.0 - radius * radius) {
          ASSERT_EQ(alpha, 1.0F) << k;
        }
        if (miss > 1.0 + radius * radius) {
          ASSERT_EQ(alpha, 0.0F) << k;
        }
        if (alpha == 0.0F) continue;
        // The last bit of half floats, to which llvmpipe cuts off.
        ASSERT_NEAR(values(result.image, "R")[k], 0.75F, 5e-4);
        ASSERT_NEAR(values(result.image, "G")[k], 0.5F, 5e-4);
        ASSERT_NEAR(values(result.image, "B")[k], 0.125F, 1e-4);
        ASSERT_EQ(srgb8_from_linear(values(result.image, "R")[k]), srgb8_from_linear(0.75F));
      }
    }
  }
}

TEST(SurfelSurface, OffsetDecidesWhatBlends) {
  // A green plane half a unit behind a red one.
  SplatCloud cloud = plane_cloud(20, 20, 0.25, kRed);
  test::append(cloud, plane_cloud(20, 20, -0.25, kGreen));
  RenderSettings settings = surfel_image({0.0, 0.0, 12.0});
  const std::size_t middle = std::size_t{48} * 96 + 48;
  settings.surfel.offset = 0.4;
  EXPECT_EQ(values(must_draw(cloud, settings).image, "G")[middle], 0.0F);
  settings.surfel.offset = 0.6;
  const RenderResult both = must_draw(cloud, settings);
  // The planes have surfels at the same places, the pixels of which differ by 4 % in perspective.
  EXPECT_NEAR(values(both.image, "G")[middle], 0.5F, 0.05F);
  EXPECT_NEAR(values(both.image, "R")[middle], 0.5F, 0.05F);
}

TEST(SurfelSurface, OffsetIsAlongTheRay) {
  // Near the corner of the image the rays to both planes are 1.25 times as long as along the axis,
  // so that 0.5 along the axis are 0.625 along them.
  SplatCloud cloud = plane_cloud(60, 60, 0.25, kRed);
  test::append(cloud, plane_cloud(60, 60, -0.25, kGreen));
  RenderSettings settings = surfel_image({0.0, 0.0, 12.0});
  settings.camera.vertical_fov_degrees = 2.0 * std::atan(0.53) * 180.0 / std::acos(-1.0);
  settings.surfel.offset = 0.56;
  const RenderResult result = must_draw(cloud, settings);
  EXPECT_GT(values(result.image, "G")[std::size_t{48} * 96 + 48], 0.1F);
  EXPECT_EQ(values(result.image, "G")[1 * 96 + 1], 0.0F);
}

TEST(SurfelSurface, BlendingFollowsTheAlphaTexture) {
  // Two discs that face the eye, one just behind the other, whose centres are half a radius apart.
  SplatCloud cloud;
  test::add_point(cloud, {-0.25, 0.0, 0.001}, {0.0F, 0.0F, 1.0F}, 1.0, kRed);
  test::add_point(cloud, {0.25, 0.0, 0.0}, {0.0F, 0.0F, 1.0F}, 1.0, kGreen);
  RenderSettings settings = surfel_image({0.0, 0.0, 4.0});
  settings.surfel.falloff = 0.7;
  const auto weight = [](glm::dvec3 position, double centre) {
    const double dx = position.x - centre;
    return std::exp(-(dx * dx + position.y * position.y) / (0.7 * 0.7));
  };
  for (const SurfelBlend blend : {SurfelBlend::Normalised, SurfelBlend::Sorted}) {
    settings.surfel.blend = blend;
    const RenderResult result = must_draw(cloud, settings);
    for (const std::size_t k : {48 * 96 + 48, 50 * 96 + 40, 44 * 96 + 55}) {
      const glm::dvec3 hit = settings.camera.eye + 4.0 * pixel_ray(settings, k % 96, k / 96);
      const double red = weight(hit, -0.25);
      const double green = weight(hit, 0.25);
      const double behind = blend == SurfelBlend::Sorted ? (1.0 - red) * green : green;
      // Half floats keep 5e-4; the discs are a thousandth apart.
      ASSERT_NEAR(values(result.image, "R")[k], red / (red + behind), 2e-3);
      ASSERT_NEAR(values(result.image, "G")[k], behind / (red + behind), 2e-3);
    }
  }
}

TEST(SurfelSurface, SortedIsByDepthNotByOrder) {
  SplatCloud front_first;
  test::add_point(front_first, {0.0, 0.0, 0.01}, {0.0F, 0.0F, 1.0F}, 1.0, kRed);
  test::add_point(front_first, {0.0, 0.0, 0.0}, {0.0F, 0.0F, 1.0F}, 1.0, kGreen);
  SplatCloud front_last;
  test::add_point(front_last, {0.0, 0.0, 0.0}, {0.0F, 0.0F, 1.0F}, 1.0, kGreen);
  test::add_point(front_last, {0.0, 0.0, 0.01}, {0.0F, 0.0F, 1.0F}, 1.0, kRed);
  RenderSettings settings = surfel_image({0.0, 0.0, 4.0});
  settings.surfel.blend = SurfelBlend::Sorted;
  const RenderResult a = must_draw(front_first, settings);
  EXPECT_TRUE(is_same(a.image, must_draw(front_last, settings).image));
  EXPECT_GT(values(a.image, "R")[std::size_t{48} * 96 + 48], 0.99F);
}

TEST(SurfelSurface, PatchesAreTheirSamples) {
  const PatchModel patches = test::sphere_model({.spacing = 0.05, .coloured = true});
  const SplatCloud samples = splats_of_samples(patches);
  const RenderSettings settings = surfel_image({2.0, 2.0, 2.0});
  const RenderResult of_patches = must_draw(RenderModel::of(patches), settings);
  EXPECT_TRUE(is_same(of_patches.image, must_draw(samples, settings).image));
  EXPECT_GT(of_patches.covered_pixels, 1000U);
  const std::vector<float>& patch = values(of_patches.image, "patch");
  EXPECT_EQ(*std::max_element(patch.begin(), patch.end()),
            static_cast<float>(patches.patches.size()));
}

TEST(SurfelSurface, CullingChangesNothingInsideOfClosedSurfaces) {
  const SplatCloud cloud = sphere_cloud(3000);
  RenderSettings settings = surfel_image({1.0, 2.0, 3.0});
  settings.count_fragments = true;
  const RenderResult all = must_draw(cloud, settings);
  settings.cull = CullMode::Back;
  const RenderResult front = must_draw(cloud, settings);
  // At the contour backs blend with fronts, and stick out.
  for (std::size_t k = 0; k < std::size_t{96} * 96; ++k) {
    if (miss_of(settings, k) > 0.97) continue;
    ASSERT_EQ(values(all.image, "G")[k], values(front.image, "G")[k]);
    ASSERT_EQ(values(all.image, "Z")[k], values(front.image, "Z")[k]);
  }
  // Backs are drawn by the first pass alone: half of its fragments.
  EXPECT_LT(*front.fragments, *all.fragments * 9 / 10);
  // A model that is known to be closed, seen from outside, and from within.
  PatchModel closed;
  closed.is_closed = true;
  closed.bounds = {glm::dvec3(-1.0), glm::dvec3(1.0)};
  RenderModel model = RenderModel::of(closed);
  model.add(cloud);
  settings.cull = CullMode::Auto;
  EXPECT_EQ(*must_draw(model, settings).fragments, *front.fragments);
  settings.camera.eye = {0.1, 0.2, 0.3};
  EXPECT_EQ(must_draw(model, settings).covered_pixels, 96U * 96U);
}

}  // namespace
}  // namespace relief
