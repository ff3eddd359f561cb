// Where the engine `ewa` puts surfaces: planes, edges, spheres, layers.
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/matrix.hpp>
#include <limits>

#include "common/scene/camera.h"
#include "tests/renderer/engines/ewa/ewa_clouds.h"
#include "tests/renderer/images.h"

namespace relief {
namespace {

using test::ewa_image;
using test::must_splat;
using test::pixel_ray;
using test::plane_cloud;
using test::values;

const std::vector<EwaFilter> kFilters{EwaFilter::Ewa, EwaFilter::SourceSpace, EwaFilter::Circular,
                                      EwaFilter::Unfiltered};

TEST(EwaSurface, PlaneIsExactAndWhole) {
  const SplatCloud cloud = plane_cloud(60, 60);
  // Magnified, one to one, minified; straight and at 35 degrees over the plane, all of the image
  // within the plane.
  for (const glm::dvec3 eye :
       {glm::dvec3(0, 0, 6), glm::dvec3(0.3, 0.2, 60), glm::dvec3(3, -2, 130),
        glm::dvec3(0, -10, 7), glm::dvec3(0, -30, 21)}) {
    for (const EwaFilter filter : kFilters) {
      RenderSettings settings = ewa_image(eye);
      settings.ewa.filter = filter;
      const RenderResult result = must_splat(cloud, settings);
      ASSERT_EQ(result.covered_pixels, 96U * 96U) << eye.z;
      for (std::size_t k = 0; k < std::size_t{96} * 96; ++k) {
        ASSERT_EQ(values(result.image, "A")[k], 1.0F) << eye.z << ' ' << static_cast<int>(filter);
        const glm::dvec3 ray = pixel_ray(settings, k % 96, k / 96);
        const double depth = -eye.z / ray.z;
        // Each contribution has the exact depth of the plane; floats keep 6e-8 of it. Unfiltered
        // points that were moved to their pixel's middle bring their own depth there.
        const bool moved = filter == EwaFilter::Unfiltered && eye.z > 60;
        ASSERT_NEAR(values(result.image, "Z")[k], depth, (moved ? 2e-2 : 1e-6) * depth)
            << eye.z << ' ' << static_cast<int>(filter);
        ASSERT_NEAR(values(result.image, "N.Z")[k], 1.0F, 1e-6);
        ASSERT_NEAR(values(result.image, "G")[k], 0.5F, 1e-6);
      }
    }
  }
}

TEST(EwaSurface, EdgeOfAHalfPlaneIsCoveredAsTheoryStates) {
  // One pixel a unit, so the kernels have a variance of 1 + 1 pixels, and their sum at a distance d
  // (pixels) from the edge, which lies half a unit beyond the last points, is the Gaussian's
  // integral Phi(d / sqrt 2). The sum over points differs from it by the midpoint rule's end
  // correction, at most 1/24 of the Gaussian's largest slope, 0.242 / 2: 0.005.
  const SplatCloud cloud = plane_cloud(70, 0);
  RenderSettings settings = ewa_image({0.0, 0.0, test::distance_for(1.0)});
  settings.ewa.cutoff = 20.0;
  settings.ewa.coverage_threshold = 1.0;
  const RenderResult result = must_splat(cloud, settings);
  for (std::size_t x = 0; x < 96; ++x) {
    const double beyond = static_cast<double>(x) + 0.5 - 48.0 - 0.5;
    const double expected = 0.5 * std::erfc(beyond / 2.0);
    EXPECT_NEAR(values(result.image, "A")[std::size_t{48} * 96 + x], expected, 0.006) << x;
  }
}

TEST(EwaSurface, CoverageFallsMonotonicallyOverAnEdge) {
  // With the default cutoff kernels end sqrt(2 c (1 + 1)) = 2 pixels from their points: whole up to
  // there, nothing beyond.
  const SplatCloud cloud = plane_cloud(70, 0);
  const RenderResult result = must_splat(cloud, ewa_image({0.0, 0.0, test::distance_for(1.0)}));
  const float* const row = values(result.image, "A").data() + std::size_t{48} * 96;
  for (std::size_t x = 1; x < 96; ++x) EXPECT_LE(row[x], row[x - 1]) << x;
  EXPECT_EQ(row[47], 1.0F);
  EXPECT_EQ(row[50], 0.0F);
  EXPECT_GT(row[48], 0.0F);
  EXPECT_LT(row[49], 1.0F);
}

TEST(EwaSurface, SphereIsWholeAndRound) {
  const int points = 20000;
  const SplatCloud cloud = test::sphere_cloud(points);
  const double h = cloud.radii[0];
  for (const double distance : {4.0, 2.0, 1.3}) {
    const RenderSettings settings = ewa_image({0.0, 0.0, distance});
    const RenderResult result = must_splat(cloud, settings);
    const double pixel = 2.0 * std::tan(std::numbers::pi / 9.0) / settings.height;
    std::size_t looked_at = 0;
    for (std::size_t k = 0; k < std::size_t{96} * 96; ++k) {
      const glm::dvec3 ray = pixel_ray(settings, k % 96, k / 96);
      const double a = glm::dot(ray, ray);
      const double b = glm::dot(ray, settings.camera.eye);
      const double root = b * b - a * (distance * distance - 1.0);
      if (root <= 0.0) continue;
      const double depth = (-b - std::sqrt(root)) / a;
      const glm::dvec3 normal = settings.camera.eye + depth * ray;
      const double cosine = -glm::dot(normal, glm::normalize(ray));
      if (cosine < 0.35) continue;
      ++looked_at;
      ASSERT_EQ(values(result.image, "A")[k], 1.0F);
      // A kernel reaches r = sqrt(2 (h^2 + footprint^2)) over its tangent plane, which there is
      // r^2 / 2 before the unit sphere; seen along the ray that is 1 / cosine as much. The normal
      // of a point at r is off by r, but the sum is symmetric about the pixel up to the scatter of
      // the points and the affine approximation: a third of r holds all pixels.
      const double footprint = pixel * depth / cosine;
      const double reach = std::sqrt(2.0 * (h * h + footprint * footprint));
      EXPECT_NEAR(values(result.image, "Z")[k], depth - 0.25 * reach * reach / cosine,
                  0.3 * reach * reach / cosine);
      const glm::dvec3 seen(values(result.image, "N.X")[k], values(result.image, "N.Y")[k],
                            values(result.image, "N.Z")[k]);
      EXPECT_LT(glm::length(seen - normal), reach / 3.0);
    }
    EXPECT_GT(looked_at, 1500U);
  }
}

TEST(EwaSurface, TransparentLayersBlendByEquation12) {
  // Red at half opacity before green before blue, in both orders of the points.
  SplatCloud layers[3];
  const glm::vec4 colours[] = {
      {1.0F, 0.0F, 0.0F, 0.5F}, {0.0F, 1.0F, 0.0F, 0.5F}, {0.0F, 0.0F, 1.0F, 1.0F}};
  for (int i = 0; i < 3; ++i) layers[i] = plane_cloud(40, 40, -20.0 * i, colours[i]);
  SplatCloud front_first;
  SplatCloud back_first;
  for (int i = 0; i < 3; ++i) {
    test::append(front_first, layers[i]);
    test::append(back_first, layers[2 - i]);
  }
  RenderSettings settings = ewa_image({0.0, 0.0, 20.0}, 32);
  settings.ewa.layers = 3;
  for (const SplatCloud* cloud : {&front_first, &back_first}) {
    const RenderResult result = must_splat(*cloud, settings);
    for (std::size_t k = 0; k < std::size_t{32} * 32; ++k) {
      // 1/2 red, 1/4 green, 1/4 blue; floats.
      ASSERT_NEAR(values(result.image, "R")[k], 0.5, 1e-6);
      ASSERT_NEAR(values(result.image, "G")[k], 0.25, 1e-6);
      ASSERT_NEAR(values(result.image, "B")[k], 0.25, 1e-6);
      ASSERT_NEAR(values(result.image, "Z")[k], 20.0, 1e-5);
    }
  }
  settings.ewa.layers = 1;  // the front surface alone
  const RenderResult front = must_splat(back_first, settings);
  for (std::size_t k = 0; k < std::size_t{32} * 32; ++k) {
    ASSERT_NEAR(values(front.image, "R")[k], 0.5, 1e-6);
    ASSERT_EQ(values(front.image, "G")[k], 0.0F);
    ASSERT_NEAR(values(front.image, "A")[k], 0.5, 1e-6);
  }
}

TEST(EwaSurface, SamplesOfPatchesLieWhereOnepassDrawsThem) {
  const PatchModel plane = test::height_field(40, [](double x, double) { return 0.5 * x; });
  RenderSettings settings = ewa_image({24.0, 18.0, 108.0}, 48);
  settings.camera.vertical_fov_degrees = 5.0;
  settings.ewa.cutoff = 8.0;
  const RenderResult splats = test::must_render(plane, settings);
  settings.engine = "onepass";
  const RenderResult patches = test::must_render(plane, settings);
  ASSERT_EQ(splats.covered_pixels, 48U * 48U);
  ASSERT_EQ(patches.covered_pixels, 48U * 48U);
  for (std::size_t k = 0; k < std::size_t{48} * 48; ++k) {
    // Heights are in steps of spacing / 1000, normals in 16 bits; onepass keeps half-float normals.
    EXPECT_NEAR(values(splats.image, "Z")[k], values(patches.image, "Z")[k], 5e-3);
    EXPECT_NEAR(values(splats.image, "N.X")[k], values(patches.image, "N.X")[k], 2e-3);
    EXPECT_EQ(values(splats.image, "patch")[k], 1.0F);
    // The weighted mean of the samples' coordinates about the pixel. Gaussians as wide as the grid
    // reproduce it to exp(-2 pi^2); the cutoff leaves out e^-8 at up to four cells. Perspective
    // makes kernels larger on the near side, by e = 1/2 / 108 or less a cell, which moves the mean
    // by 3 e h^2 (the fourth moment over the second): 0.016 cells; the ray's own slant adds as
    // much.
    EXPECT_NEAR(values(splats.image, "UV.U")[k], values(patches.image, "UV.U")[k], 0.05);
    EXPECT_NEAR(values(splats.image, "UV.V")[k], values(patches.image, "UV.V")[k], 0.05);
  }
}

}  // namespace
}  // namespace relief
