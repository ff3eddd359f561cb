// The truths of volumes and 3D Gaussians against closed forms.
#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <random>

#include "renderer/engines/volume_truth/field_truth.h"
#include "renderer/engines/volume_truth/gaussian_truth.h"
#include "renderer/engines/volume_truth/kernel_truth.h"
#include "renderer/render.h"
#include "renderer/volume/splats/footprint.h"

namespace relief {
namespace {

using volume_truth::FieldScene;
using volume_truth::GaussianOrder;
using volume_truth::NodeKernels;
using volume_truth::RaySum;
using volume_truth::SampleImage;
using volume_truth::ValueField;

/// Looks along -z, past the origin if `aside` is not 0, from a distance; an image of `side` pixels.
View view_along_z(double distance, std::uint32_t side, double orthographic_height,
                  glm::dvec3 aside = {}) {
  const glm::dvec3 eye = glm::dvec3(0.0, 0.0, distance) + aside;
  const Camera camera{
      eye, eye - glm::dvec3(0.0, 0.0, 1.0), {0.0, 1.0, 0.0}, 60.0, orthographic_height};
  return make_view(camera, side, side, 1e-6);
}

/// Kernels of weight `weight` at all nodes of a grid with spacing 1 about the origin.
struct Nodes {
  KernelCloud cloud;
  std::vector<glm::vec3> colours;
  RegularGrid grid;
};

Nodes equal_nodes(glm::uvec3 size, float weight) {
  Nodes nodes;
  nodes.grid.origin = -0.5 * glm::dvec3(size - 1U);
  nodes.cloud.size = size;
  nodes.cloud.variances = {{1.0, 0.0, 0.0, 1.0, 0.0, 1.0}};
  for (std::uint32_t n = 0; n < size.x * size.y * size.z; ++n) {
    nodes.cloud.nodes.push_back(n);
    nodes.cloud.weights.push_back(weight);
    nodes.cloud.centres.push_back(
        nodes.grid.origin + glm::dvec3(n % size.x, n / size.x % size.y, n / (size.x * size.y)));
    nodes.colours.emplace_back(1.0F, 0.5F, 0.25F);
  }
  return nodes;
}

SampleImage integrated(const Nodes& nodes, const View& view, double step) {
  Progress silent;
  SampleImage image(view, 1);
  const NodeKernels kernels(nodes.cloud, nodes.colours, nodes.grid, 1.0);
  volume_truth::integrate_kernels(kernels, nodes.grid, view, step, image, silent);
  return image;
}

double optical_depth(const RaySum& ray) {
  return -std::log(ray.transmittance);
}

TEST(KernelTruth, OneKernelSeenInParallelIsItsFootprint) {
  const Nodes nodes = equal_nodes({1, 1, 1}, 0.75F);
  const View view = view_along_z(50.0, 9, 6.0);
  const SampleImage image = integrated(nodes, view, 0.5);
  FootprintRule rule;
  rule.filter = VolumeFilter::Unfiltered;
  rule.cutoff = 60.0;  // nothing is beyond, so that nothing is made up for
  const auto footprint = footprint_of(nodes.cloud, 0, ray_camera(view), rule);
  ASSERT_TRUE(footprint);
  for (std::int64_t y = 0; y < 9; ++y) {
    for (std::int64_t x = 0; x < 9; ++x) {
      const double q = footprint->q(image.window(x, y) - footprint->centre);
      // The truth's kernels end at 6.5 standard deviations: 2e-10 of them is beyond.
      EXPECT_NEAR(optical_depth(image.rays[image.index(x, y)]),
                  footprint->peak * std::exp(-0.5 * q), 1e-9);
    }
  }
}

TEST(KernelTruth, ASlabOfEqualNodesLetsThroughWhatItsThicknessDoes) {
  const Nodes nodes = equal_nodes({24, 24, 5}, 0.3F);
  const SampleImage image = integrated(nodes, view_along_z(50.0, 1, 1.0), 0.5);
  // Kernels of equal weight sum up to it within 1e-8 (4 exp(-2 pi^2)); the slab ends 11 standard
  // deviations from the ray. The weight is a float.
  EXPECT_NEAR(optical_depth(image.rays[0]), 5.0 * double{0.3F}, 5e-8);
  const double opacity = 1.0 - image.rays[0].transmittance;
  EXPECT_NEAR(image.rays[0].colour.x, opacity, 1e-6);
  EXPECT_NEAR(image.rays[0].colour.y, 0.5 * opacity, 1e-6);
}

TEST(KernelTruth, AnEyeWithinAKernelSeesTheRestOfIt) {
  const Nodes nodes = equal_nodes({1, 1, 1}, 2.0F);
  for (const double distance : {0.0, 0.1, 0.77, 3.0}) {
    const SampleImage image = integrated(nodes, view_along_z(distance, 1, 0.0), 0.25);
    // The middle of a unit Gaussian across the ray, and what is below `distance` along it.
    const double expected =
        2.0 / (2.0 * std::acos(-1.0)) * 0.5 * std::erfc(-distance / std::sqrt(2.0));
    // Simpson's rule from the eye to the first plane, and cubics after it.
    EXPECT_NEAR(optical_depth(image.rays[0]), expected, 1e-4) << distance;
    EXPECT_TRUE(std::isfinite(image.rays[0].colour.x));
  }
}

/// A volume of random values, and a function with thin and opaque layers.
ScalarVolume random_volume(glm::uvec3 size) {
  ScalarVolume volume;
  volume.size = size;
  volume.placement = RegularGrid{-0.5 * glm::dvec3(size - 1U), glm::dmat3(1.0)};
  std::mt19937 random(3);
  std::uniform_real_distribution<float> value(0.0F, 1.0F);
  for (std::size_t n = 0; n < nodes_of(volume); ++n) volume.values.push_back(value(random));
  return volume;
}

TransferFunction steep_function() {
  return {{{0.3, {1.0F, 0.0F, 0.0F}}, {0.5, {0.0F, 1.0F, 0.0F}}, {0.8, {0.2F, 0.2F, 1.0F}}},
          {{0.4, 0.0}, {0.5, 0.5}, {0.6, 0.05}, {0.9, 0.99}},
          {},
          1.0};
}

SampleImage field_image(const ScalarVolume& volume, const TransferFunction& function,
                        const View& view, double step, std::optional<double> iso = {}) {
  Progress silent;
  const ValueField field(volume, silent);
  SampleImage image(view, 1);
  const FieldScene scene{.field = field,
                         .grid = std::get<RegularGrid>(volume.placement),
                         .function = function,
                         .iso = iso,
                         .iso_opacity = 0.75};
  volume_truth::integrate_field(scene, view, step, image, silent);
  return image;
}

double largest_difference(const SampleImage& a, const SampleImage& b) {
  double largest = 0.0;
  for (std::size_t r = 0; r < a.rays.size(); ++r) {
    const glm::dvec3 off = glm::abs(a.rays[r].colour - b.rays[r].colour);
    largest = std::max({largest, off.x, off.y, off.z,
                        std::abs(a.rays[r].transmittance - b.rays[r].transmittance)});
  }
  return largest;
}

TEST(KernelTruth, HalfTheStepChangesNothing) {
  const ScalarVolume volume = random_volume({12, 12, 12});
  Nodes nodes = equal_nodes(volume.size, 0.0F);
  const TransferFunction function = steep_function();
  for (std::size_t n = 0; n < nodes.cloud.count(); ++n) {
    nodes.cloud.weights[n] = static_cast<float>(extinction_at(function, volume.values[n], 0.0));
    nodes.colours[n] = colour_at(function, volume.values[n]);
  }
  for (const double distance : {25.0, 4.0}) {
    const View view = view_along_z(distance, 48, 0.0, {1.0, 2.0, 0.0});
    const double off =
        largest_difference(integrated(nodes, view, 0.4), integrated(nodes, view, 0.2));
    EXPECT_LT(off, 1e-4) << distance;
    EXPECT_GT(off, 0.0);
  }
}

TEST(FieldTruth, HalfTheStepChangesNothing) {
  const ScalarVolume volume = random_volume({12, 12, 12});
  for (const double distance : {25.0, 4.0}) {
    const View view = view_along_z(distance, 48, 0.0, {1.0, 2.0, 0.0});
    const double off = largest_difference(field_image(volume, steep_function(), view, 0.4),
                                          field_image(volume, steep_function(), view, 0.2));
    EXPECT_LT(off, 1e-4) << distance;
    EXPECT_GT(off, 0.0);
  }
}

TEST(FieldTruth, ASlabLetsThroughWhatItsThicknessDoes) {
  ScalarVolume volume = random_volume({9, 9, 6});
  std::fill(volume.values.begin(), volume.values.end(), 0.5F);
  const SampleImage image = field_image(volume, steep_function(), view_along_z(50.0, 4, 2.0), 0.5);
  // An opacity of 0.5 a unit, and 5 units from the first node to the last.
  for (const RaySum& ray : image.rays) EXPECT_NEAR(ray.transmittance, std::pow(0.5, 5.0), 1e-9);
}

TEST(FieldTruth, ASurfaceIsWhereTheValueIs) {
  // The value is the height.
  ScalarVolume volume = random_volume({5, 5, 9});
  for (std::size_t n = 0; n < nodes_of(volume); ++n)
    volume.values[n] = static_cast<float>(n / 25) - 4.0F;
  const TransferFunction clear{{{0.0, glm::vec3(1.0F)}}, {{0.0, 0.0}}, {}, 1.0};
  const SampleImage image = field_image(volume, clear, view_along_z(50.0, 4, 2.0), 0.5, 1.3);
  for (const RaySum& ray : image.rays) {
    EXPECT_NEAR(ray.transmittance, 0.25, 1e-12);
    EXPECT_NEAR(ray.depth, 50.0 - 1.3, 1e-6);  // values are floats
  }
}

TEST(FieldTruth, NothingIsSeenWhereValuesAreMissing) {
  ScalarVolume volume = random_volume({6, 6, 6});
  std::fill(volume.values.begin(), volume.values.end(), std::nanf(""));
  const SampleImage image = field_image(volume, steep_function(), view_along_z(2.0, 8, 0.0), 0.5);
  for (const RaySum& ray : image.rays) EXPECT_EQ(ray.transmittance, 1.0);
}

/// Two Gaussians: a needle that leans away to the right, and a ball behind its centre.
KernelCloud leaning_needle() {
  KernelCloud cloud;
  cloud.weight = KernelWeight::Peak;
  cloud.centres = {{0.0, 0.0, 0.0}, {2.0, 0.0, -1.0}};
  const glm::dvec3 axis = glm::normalize(glm::dvec3(1.0, 0.0, -1.5));
  glm::dmat3 needle = 4.0 * glm::outerProduct(axis, axis) + 0.04 * glm::dmat3(1.0);
  cloud.variances = {variance_of(needle), {0.3, 0.0, 0.0, 0.3, 0.0, 0.3}};
  cloud.weights = {0.8F, 0.8F};
  return cloud;
}

TEST(GaussianTruth, OrderOnTheRayIsNotThatOfCentres) {
  const KernelCloud cloud = leaning_needle();
  const std::vector<glm::vec3> colours{{1.0F, 0.0F, 0.0F}, {0.0F, 1.0F, 0.0F}};
  const View view = view_along_z(10.0, 1, 1.0, {2.0, 0.0, 0.0});
  Progress silent;
  std::vector<RaySum> rays;
  for (const GaussianOrder order : {GaussianOrder::Ray, GaussianOrder::Centre}) {
    SampleImage image(view, 1);
    volume_truth::meet_gaussians(cloud, colours, view, {}, order, image, silent);
    rays.push_back(image.rays[0]);
  }
  const double ball = double{0.8F};
  EXPECT_NEAR(rays[0].colour.y, ball, 1e-12);  // by ray: nothing is before the ball
  EXPECT_LT(rays[1].colour.y, 0.9 * ball);     // by centre: the needle is
  EXPECT_NEAR(rays[0].transmittance, rays[1].transmittance, 1e-12);
}

TEST(GaussianTruth, EveryPixelHasTheLargestDensityOnItsRay) {
  const KernelCloud cloud = leaning_needle();
  const View view = view_along_z(6.0, 32, 0.0);
  SampleImage image(view, 1);
  Progress silent;
  volume_truth::meet_gaussians(cloud, std::vector<glm::vec3>(2, glm::vec3(1.0F)), view, {},
                               GaussianOrder::Ray, image, silent);
  // All pixels, so that the bounds of tiles are seen to leave out nothing.
  for (std::int64_t y = 0; y < 32; ++y) {
    for (std::int64_t x = 0; x < 32; ++x) {
      const glm::dvec3 d = ray_through(view, image.window(x, y));
      double through = 1.0;
      for (std::size_t k = 0; k < 2; ++k) {
        const glm::dmat3 q = glm::inverse(matrix_of(cloud.variances[k]));
        const glm::dvec3 to = view.eye - cloud.centres[k];
        const glm::dvec3 p = to - glm::dot(d, q * to) / glm::dot(d, q * d) * d;
        const double alpha = cloud.weights[k] * std::exp(-0.5 * glm::dot(p, q * p));
        if (alpha >= 1.0 / 255.0) through *= 1.0 - alpha;
      }
      EXPECT_NEAR(image.rays[image.index(x, y)].transmittance, through, 1e-9);
    }
  }
}

TEST(GaussianTruth, AnEyeWithinGaussiansSeesNumbers) {
  const KernelCloud cloud = leaning_needle();
  Progress silent;
  for (const double distance : {0.0, 0.25, 1.0}) {
    const View view = view_along_z(distance, 16, 0.0);
    SampleImage image(view, 1);
    volume_truth::meet_gaussians(cloud, std::vector<glm::vec3>(2, glm::vec3(1.0F)), view, {},
                                 GaussianOrder::Ray, image, silent);
    for (const RaySum& ray : image.rays)
      EXPECT_TRUE(std::isfinite(ray.colour.x) && std::isfinite(ray.transmittance)) << distance;
  }
}

TEST(VolumeTruth, ImagesDoNotDependOnThreads) {
  const ScalarVolume volume = random_volume({10, 10, 10});
  RenderModel model;
  model.add(volume);
  RenderSettings settings;
  settings.engine = "volume-truth";
  settings.width = settings.height = 40;
  settings.camera = {{10.0, 7.0, 20.0}, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, 45.0};
  settings.options["samples"] = 4.0;
  for (const char* truth : {"kernels", "field"}) {
    settings.options["truth"] = std::string(truth);
    std::vector<std::vector<float>> greens;
    for (const std::size_t threads : {std::size_t{1}, std::size_t{4}}) {
      const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism,
                                              threads);
      Progress silent;
      const auto result = render(model, settings, silent);
      ASSERT_TRUE(result) << result.error().message;
      greens.push_back(result->image.find("G")->values);
    }
    EXPECT_EQ(greens[0], greens[1]) << truth;
  }
}

}  // namespace
}  // namespace relief
