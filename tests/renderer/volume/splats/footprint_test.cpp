#include "renderer/volume/splats/footprint.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "common/progress.h"
#include "renderer/volume/kernels/volume_kernels.h"

namespace relief {
namespace {

View parallel_view(double height) {
  Camera camera;
  camera.eye = {0.0, 0.0, 10.0};
  camera.orthographic_height = height;
  return make_view(camera, 200, 200, 1e-3);
}

KernelCloud one_kernel(const Variance& variance, double weight) {
  KernelCloud cloud;
  cloud.centres = {glm::dvec3(0.0)};
  cloud.variances = {variance};
  cloud.weights = {static_cast<float>(weight)};
  cloud.colours = {glm::vec3(1.0F)};
  cloud.normals = {glm::vec3(0.0F)};
  return cloud;
}

FootprintRule rule_of(VolumeFilter filter, double cutoff) {
  FootprintRule rule;
  rule.filter = filter;
  rule.cutoff = cutoff;
  return rule;
}

double integral_of(const Footprint& footprint) {
  const double determinant = footprint.xx * footprint.yy - footprint.xy * footprint.xy;
  return footprint.peak * 2.0 * 3.14159265358979323846 / std::sqrt(determinant);
}

// A pixel is 0.1 wide: an integral over space of 3 is one of 300 over the image's pixels.
TEST(Footprint, KeepsTheKernelsIntegral) {
  const View view = parallel_view(20.0);
  const KernelCloud cloud = one_kernel({0.5, 0.1, 0.05, 0.3, -0.02, 0.4}, 3.0);
  // At a cutoff of 80 nothing is lost that a double could hold: exp(-40).
  for (const VolumeFilter filter :
       {VolumeFilter::Ewa, VolumeFilter::UniformScaling, VolumeFilter::Unfiltered}) {
    const auto footprint = footprint_of(cloud, 0, ray_camera(view), rule_of(filter, 80.0));
    ASSERT_TRUE(footprint);
    EXPECT_NEAR(integral_of(*footprint), 300.0, 300.0 * 1e-9);
  }
  // What lies beyond the cutoff, exp(-C / 2), is put back.
  const auto cut = footprint_of(cloud, 0, ray_camera(view), rule_of(VolumeFilter::Ewa, 4.0));
  ASSERT_TRUE(cut);
  EXPECT_NEAR(integral_of(*cut) * (1.0 - std::exp(-2.0)), 300.0, 300.0 * 1e-9);
}

// Section 6.4: a kernel that is flattened across the image's plane has the footprint of the
// surface kernel with the variance that is left; where it leans, the ray's path in it is longer.
TEST(Footprint, OfAFlatKernelIsThatOfTheSurface) {
  const View view = parallel_view(20.0);
  const RayCamera camera = ray_camera(view);
  const double lean = 0.8;
  const glm::dvec3 normal(std::sin(lean), 0.0, std::cos(lean));
  const glm::dmat3 in_plane = glm::dmat3(1.0) - glm::outerProduct(normal, normal);
  KernelCloud flat =
      one_kernel(variance_of(in_plane + kFlatVariance * glm::outerProduct(normal, normal)), 2.0);
  flat.normals = {glm::vec3(normal)};
  const FootprintRule rule = rule_of(VolumeFilter::Unfiltered, 80.0);
  const auto volume = footprint_of(flat, 0, camera, rule);
  ASSERT_TRUE(volume);
  // M of Eq. (35): the tangent plane's axes in pixels (10 for a unit); V_r = I.
  const double across = 10.0 * std::cos(lean);
  EXPECT_NEAR(volume->xx, 1.0 / (across * across), 2.0 * kFlatVariance / (across * across));
  EXPECT_NEAR(volume->yy, 1.0 / 100.0, 1e-12);
  // G of the plane is 1 / 2 pi at its centre; the volume's integral has 1 / |n . d| as much.
  EXPECT_NEAR(volume->peak, 2.0 / (2.0 * 3.14159265358979323846) / std::cos(lean), 1e-5);
  flat.is_surface = {1};
  const auto surface = footprint_of(flat, 0, camera, rule);
  ASSERT_TRUE(surface);
  EXPECT_NEAR(surface->peak, 2.0 / (2.0 * 3.14159265358979323846), 1e-5);
}

// Figure 13: minified, both filters are a pixel wide; stretched, EWA widens the minor axis only.
TEST(Footprint, FiltersHaveTheShapesOfFigure13) {
  const View view = parallel_view(20.0);  // 10 pixels for a unit
  const RayCamera camera = ray_camera(view);
  const KernelCloud small = one_kernel({1e-8, 0, 0, 1e-8, 0, 1e-8}, 1.0);
  const auto ewa_small = footprint_of(small, 0, camera, rule_of(VolumeFilter::Ewa, 4.0));
  const auto scaled_small =
      footprint_of(small, 0, camera, rule_of(VolumeFilter::UniformScaling, 4.0));
  ASSERT_TRUE(ewa_small && scaled_small);
  EXPECT_NEAR(ewa_small->xx, 1.0, 1e-5);
  EXPECT_NEAR(scaled_small->xx, 1.0, 1e-5);
  // Standard deviations of 4 and 0.1 pixels.
  const KernelCloud stretched = one_kernel({0.16, 0, 0, 1e-4, 0, 1e-4}, 1.0);
  const auto ewa = footprint_of(stretched, 0, camera, rule_of(VolumeFilter::Ewa, 4.0));
  const auto scaled =
      footprint_of(stretched, 0, camera, rule_of(VolumeFilter::UniformScaling, 4.0));
  ASSERT_TRUE(ewa && scaled);
  EXPECT_NEAR(1.0 / ewa->xx, 17.0, 1e-6);
  EXPECT_NEAR(1.0 / ewa->yy, 1.01, 1e-6);
  EXPECT_NEAR(1.0 / scaled->xx, 1600.0, 1e-3);
  EXPECT_NEAR(1.0 / scaled->yy, 1.0, 1e-6);
}

// A 3D Gaussian with `ewa` is as wide as a dilated one, and keeps its integral: what gsplat,
// PlayCanvas and GaussianSplats3D draw where a scene was trained so.
TEST(Footprint, Of3dGaussiansHasTheFilterOfTheirTraining) {
  const RayCamera camera = ray_camera(parallel_view(20.0));  // 10 pixels for a unit
  KernelCloud cloud = one_kernel({0.16, 0, 0, 1e-4, 0, 1e-4}, 0.5);
  cloud.weight = KernelWeight::Peak;
  FootprintRule rule = rule_of(VolumeFilter::Dilated, 4.0);
  rule.weight = KernelWeight::Peak;
  const auto dilated = footprint_of(cloud, 0, camera, rule);
  rule.filter = VolumeFilter::Ewa;
  const auto ewa = footprint_of(cloud, 0, camera, rule);
  ASSERT_TRUE(dilated && ewa);
  EXPECT_NEAR(1.0 / ewa->xx, 16.3, 1e-9);
  EXPECT_NEAR(1.0 / ewa->yy, 0.31, 1e-9);
  EXPECT_EQ(dilated->xx, ewa->xx);
  EXPECT_EQ(dilated->yy, ewa->yy);
  EXPECT_EQ(dilated->peak, 0.5);
  EXPECT_NEAR(ewa->peak, 0.5 * std::sqrt(16.0 * 0.01 / (16.3 * 0.31)), 1e-9);
}

TEST(Footprint, IsNoneWhereTheApproximationHasNoMeaning) {
  Camera camera;
  camera.eye = {0.0, 0.0, 10.0};
  const View view = make_view(camera, 200, 200, 1e-3);
  KernelCloud cloud = one_kernel({1, 0, 0, 1, 0, 1}, 1.0);
  const FootprintRule rule = rule_of(VolumeFilter::Ewa, 4.0);
  // Behind the eye, in its plane, and across it.
  for (const double z : {12.0, 10.0, 9.5}) {
    cloud.centres = {{3.0, 0.0, z}};
    EXPECT_FALSE(footprint_of(cloud, 0, ray_camera(view), rule)) << z;
  }
  cloud.centres = {{3.0, 0.0, 8.0}};
  EXPECT_TRUE(footprint_of(cloud, 0, ray_camera(view), rule));
}

// Kernels of a standard deviation of one spacing sum up to 1 within 2 exp(-2 pi^2) = 5e-9.
TEST(VolumeKernels, SumUpToTheExtinction) {
  ScalarVolume volume;
  volume.size = glm::uvec3(25);
  volume.placement = RegularGrid{glm::dvec3(0.0), glm::dmat3(0.5, 0, 0, 0, 2.0, 0, 0.3, 0, 1.5)};
  volume.values.assign(nodes_of(volume), 1.0F);
  const TransferFunction function{{{0.0, glm::vec3(1.0F)}}, {{0.0, 0.5}}, {}, 1.0};
  const Progress progress;
  const KernelCloud cloud = kernels_of_volume(volume, function, VolumeSettings(), progress);
  ASSERT_EQ(cloud.count(), nodes_of(volume));
  const glm::dmat3 variance = matrix_of(cloud.variance(0));
  const glm::dmat3 conic = glm::inverse(variance);
  const double scale =
      std::pow(2.0 * 3.14159265358979323846, -1.5) / std::sqrt(glm::determinant(variance));
  const auto& grid = std::get<RegularGrid>(volume.placement);
  for (const glm::dvec3 at : {glm::dvec3(12.0), glm::dvec3(12.5, 12.25, 12.1)}) {
    const glm::dvec3 x = grid.origin + grid.step * at;
    double sum = 0.0;
    for (std::size_t k = 0; k < cloud.count(); ++k) {
      const glm::dvec3 d = x - cloud.centres[k];
      sum += cloud.weights[k] * scale * std::exp(-0.5 * glm::dot(d, conic * d));
    }
    EXPECT_NEAR(sum, std::log(2.0), 1e-6 * std::log(2.0));
  }
}

}  // namespace
}  // namespace relief
