// Kernels among opaque surfaces: the share of a kernel before a surface, and images of both.
#include "renderer/volume/surfaces_beside.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>

#include "renderer/render.h"
#include "renderer/volume/splats/share_before.h"
#include "tests/common/patch_file/sample_models.h"
#include "tests/renderer/images.h"
#include "tests/renderer/scenes.h"

namespace relief::test {
namespace {

constexpr float kInfinite = std::numeric_limits<float>::infinity();

View view_from_front() {
  Camera camera;
  camera.eye = {0.0, 0.0, 10.0};
  camera.orthographic_height = 8.0;
  return make_view(camera, 80, 80, 1e-3);
}

/// The share of a kernel's density on the ray through a pixel that lies before a depth, by adding
/// up slices of the ray: x and y of the ray, world.
double share_by_sum(const glm::dmat3& variance, glm::dvec2 ray, double eye_z, double depth) {
  const glm::dmat3 inverse = glm::inverse(variance);
  constexpr int kSlices = 200000;
  constexpr double kHalf = 12.0;
  double before = 0.0;
  double all = 0.0;
  for (int s = 0; s < kSlices; ++s) {
    const double z = -kHalf + 2.0 * kHalf * (s + 0.5) / kSlices;
    const glm::dvec3 p(ray, z);
    const double density = std::exp(-0.5 * glm::dot(p, inverse * p));
    all += density;
    if (eye_z - z < depth) before += density;
  }
  return before / all;
}

TEST(ShareBefore, IsTheIntegralAlongTheRay) {
  const View view = view_from_front();
  KernelCloud cloud;
  cloud.centres = {glm::dvec3(0.0)};
  cloud.variances = {{0.9, 0.2, 0.4, 0.7, -0.3, 1.1}};
  cloud.weights = {1.0F};
  FootprintRule rule;
  rule.filter = VolumeFilter::Unfiltered;
  const auto footprint = footprint_of(cloud, 0, ray_camera(view), rule);
  ASSERT_TRUE(footprint);
  for (const glm::dvec2 ray : {glm::dvec2(0.0), {0.7, -0.4}, {-1.1, 0.9}}) {
    for (const double depth : {8.0, 9.5, 10.0, 10.4, 12.0}) {
      // A pixel is 0.1 wide.
      const double share = share_before(*footprint, ray / 0.1, depth);
      // The sum's slices are 1.2e-4 thick, and the density of a share at most 0.5 a unit.
      EXPECT_NEAR(share, share_by_sum(matrix_of(cloud.variances[0]), ray, 10.0, depth), 1e-4)
          << ray.x << ' ' << depth;
    }
  }
}

TEST(ShareBefore, EndsAndFlatKernels) {
  Footprint footprint;
  footprint.depth = 5.0;
  footprint.depth_deviation = 0.5;
  EXPECT_EQ(share_before(footprint, {}, kInfinite), 1.0);
  EXPECT_EQ(share_before(footprint, {}, -kInfinite), 0.0);
  EXPECT_EQ(share_before(footprint, {}, 5.0), 0.5);
  footprint.depth_deviation = 0.0;
  EXPECT_EQ(share_before(footprint, {}, 5.1), 1.0);
  EXPECT_EQ(share_before(footprint, {}, 4.9), 0.0);
}

TEST(ShareBefore, OpacitiesAreThoseOfTheirOpticalDepths) {
  EXPECT_EQ(weight_before(0.6, 0.25, KernelWeight::Integral), 0.15);
  EXPECT_EQ(weight_before(0.6, 1.0, KernelWeight::Peak), 0.6);
  EXPECT_EQ(weight_before(0.6, 0.0, KernelWeight::Peak), 0.0);
  // Two halves one behind the other are the whole.
  const double half = weight_before(0.6, 0.5, KernelWeight::Peak);
  EXPECT_NEAR(1.0 - (1.0 - half) * (1.0 - half), 0.6, 1e-15);
  EXPECT_EQ(weight_before(1.0, 0.5, KernelWeight::Peak), 1.0);
}

FilmPixel pixel_of(float value, float alpha, float depth) {
  FilmPixel pixel;
  pixel.colour = glm::vec4(glm::vec3(value), alpha);
  pixel.depth = depth;
  return pixel;
}

TEST(DepthLimits, AnEdgeHasBothParts) {
  const Film film{3, 1, {pixel_of(1.0F, 1.0F, 4.0F), pixel_of(0.3F, 0.3F, kInfinite), FilmPixel()}};
  const DepthLimits limits = depth_limits(film);
  EXPECT_EQ(limits.covered, (std::vector<float>{4.0F, 4.0F, kInfinite}));
  EXPECT_EQ(limits.beside, (std::vector<float>{-kInfinite, kInfinite, -kInfinite}));
  EXPECT_TRUE(depth_limits({1, 1, {pixel_of(1.0F, 1.0F, 4.0F)}}).beside.empty());
}

TEST(LaidOver, AnEdgeShowsBothParts) {
  const Film surfaces{1, 1, {pixel_of(0.25F, 0.25F, 4.0F)}};
  const Film covered{1, 1, {pixel_of(0.1F, 0.2F, kInfinite)}};
  const Film beside{1, 1, {pixel_of(0.4F, 0.8F, 3.0F)}};
  const FilmPixel pixel = laid_over(surfaces, covered, beside).pixels.front();
  // A quarter: 0.1 over the surface's 1; three quarters: 0.4 over nothing.
  EXPECT_NEAR(pixel.colour.r, 0.25F * (0.1F + 0.8F) + 0.75F * 0.4F, 1e-6F);
  EXPECT_NEAR(pixel.colour.a, 0.25F + 0.75F * 0.8F, 1e-6F);
  EXPECT_EQ(pixel.depth, 4.0F) << "kernels before the surface cover less than half";
}

/// A ball of radius 6 about the origin: 1 in its middle, nodes 0.5 apart.
ScalarVolume ball() {
  constexpr std::uint32_t kNodes = 33;
  ScalarVolume volume{glm::uvec3(kNodes), RegularGrid{glm::dvec3(-8.0), glm::dmat3(0.5)}, {}};
  for (std::uint32_t k = 0; k < kNodes; ++k) {
    for (std::uint32_t j = 0; j < kNodes; ++j) {
      for (std::uint32_t i = 0; i < kNodes; ++i) {
        const double r = glm::length(glm::dvec3(-8.0) + 0.5 * glm::dvec3(i, j, k));
        volume.values.push_back(static_cast<float>(std::max(1.0 - r / 6.0, 0.0)));
      }
    }
  }
  return volume;
}

GaussianCloud one_gaussian(glm::vec3 centre) {
  GaussianCloud cloud;
  cloud.centres = {centre};
  cloud.scales = {{2.0F, 1.5F, 1.0F}};
  cloud.rotations = {glm::normalize(glm::quat(0.9F, 0.1F, 0.3F, 0.2F))};
  cloud.opacities = {0.9F};
  cloud.harmonics = {glm::vec3(0.8F, -0.5F, 0.3F)};
  return cloud;
}

class AmongSurfaces : public testing::Test {
 protected:
  /// White everywhere.
  std::string white() {
    const std::filesystem::path file = folder_ / "white.json";
    spill(file, R"({"colour": [[0, 1, 1, 1]], "opacity": [[0, 0], [1, 0.5]], "unit_length": 1})");
    return file.string();
  }
  RenderSettings settings(const char* engine) {
    RenderSettings settings;
    settings.engine = engine;
    settings.width = 64;
    settings.height = 64;
    settings.camera.eye = {0.0, 0.0, 30.0};
    settings.camera.orthographic_height = 14.0;
    settings.background.reset();
    settings.material = Material::Unlit;
    settings.raytrace.samples = 1;
    settings.volume.transfer = white();
    settings.debug = true;
    return settings;
  }
  Image draw(const RenderSettings& settings) {
    RenderModel model = RenderModel::of(plane_);
    model.add(parts_);
    Progress silent;
    auto result = render(model, settings, silent);
    if (result) return std::move(result->image);
    ADD_FAILURE() << result.error().message;
    return {};
  }
  /// How far colours of the two engines are apart.
  struct Apart {
    float most = 0.0F;
    double mean = 0.0;
  };
  Apart compare(RenderSettings wanted) {
    wanted.engine = "volume";
    const Image drawn = draw(wanted);
    wanted.engine = "volume-reference";
    const Image truth = draw(wanted);
    Apart apart;
    for (const char* const name : {"R", "G", "B", "A"}) {
      const auto& a = values(drawn, name);
      const auto& b = values(truth, name);
      for (std::size_t k = 0; k < a.size(); ++k) {
        EXPECT_TRUE(std::isfinite(a[k])) << name;
        const float off = std::abs(a[k] - b.at(k));
        apart.most = std::max(apart.most, off);
        apart.mean += static_cast<double>(off) / static_cast<double>(4 * a.size());
      }
    }
    return apart;
  }

  /// The square from -10 to 10 in z = 0.
  PatchModel plane_ = height_field(21, [](double, double) { return 0.0; });
  VolumeParts parts_;
  ScratchFolder folder_;
};

// The plane cuts the ball into halves whose optical depths are equal: what comes through the front
// half is the root of what comes through the whole. Nodes in the plane itself count half.
TEST_F(AmongSurfaces, HalfABallStandsBeforeAPlane) {
  parts_.list.push_back({ball()});
  RenderSettings wanted = settings("volume-reference");
  wanted.volume.attenuation = Attenuation::Exponential;
  const Image both = draw(wanted);
  wanted.volume.transfer = "none";
  const Image plane = draw(wanted);
  wanted.volume.transfer = white();
  plane_ = {};
  const Image alone = draw(wanted);
  std::size_t translucent = 0;
  for (std::size_t k = 0; k < values(both, "R").size(); ++k) {
    const float through = std::sqrt(1.0F - values(alone, "A")[k]);
    translucent += through < 0.9F ? 1U : 0U;
    ASSERT_EQ(values(both, "A")[k], 1.0F);
    // A float's rounding of A, which the root of small values enlarges.
    ASSERT_NEAR(values(both, "R")[k], 1.0F - through + through * values(plane, "R")[k], 1e-4F);
  }
  EXPECT_GT(translucent, 1000U) << "the test shows something";
}

TEST_F(AmongSurfaces, WhatIsBehindIsHidden) {
  parts_.list.push_back({one_gaussian({0.0F, 0.0F, -8.0F})});
  const Image image = draw(settings("volume-reference"));
  parts_.list.front() = {one_gaussian({0.0F, 0.0F, 8.0F})};
  const Image before = draw(settings("volume-reference"));
  const std::size_t middle = 32 * 64 + 32;
  const std::size_t corner = 2 * 64 + 2;
  EXPECT_EQ(values(image, "G")[middle], values(image, "G")[corner]);
  EXPECT_GT(std::abs(values(before, "G")[middle] - values(before, "G")[corner]), 0.1F);
}

TEST_F(AmongSurfaces, DepthIsThatOfWhatCoversHalf) {
  parts_.list.push_back({one_gaussian({0.0F, 0.0F, 8.0F})});
  RenderSettings wanted = settings("volume-reference");
  wanted.outputs = all_outputs();
  for (const char* const engine : {"volume-reference", "volume"}) {
    wanted.engine = engine;
    const Image image = draw(wanted);
    EXPECT_NEAR(values(image, "Z")[32 * 64 + 32], 22.0F, 0.1F);
    EXPECT_EQ(values(image, "patch")[32 * 64 + 32], 0.0F);
    EXPECT_NEAR(values(image, "Z")[2 * 64 + 2], 30.0F, 1e-3F);
    EXPECT_EQ(values(image, "patch")[2 * 64 + 2], 1.0F);
    EXPECT_NEAR(values(image, "N.Z")[2 * 64 + 2], 1.0F, 1e-3F);
  }
}

TEST_F(AmongSurfaces, OpenGlDrawsTheSame) {
  RenderSettings wanted = settings("volume");
  wanted.camera.eye = {4.0, 3.0, 12.0};  // the plane fills the image
  wanted.camera.orthographic_height = 0.0;
  for (const VolumeDrawingBy by : {VolumeDrawingBy::Shaders, VolumeDrawingBy::Cpu}) {
    wanted.volume.drawn_by = by;
    // Half floats of the surface's colour: 5e-4.
    constexpr float kLists = 1e-3F;
    parts_.list = {{ball()}};
    // Sheets of shaders have the pixel's Jacobian in place of the kernel's centre.
    EXPECT_LT(compare(wanted).most, by == VolumeDrawingBy::Cpu ? kLists : 0.01F);
    wanted.volume.visibility = VolumeVisibility::ImageSheet;
    EXPECT_LT(compare(wanted).most, kLists);
    wanted.volume.visibility = VolumeVisibility::Automatic;
    parts_.list.push_back({one_gaussian({2.0F, 1.0F, 0.5F})});
    EXPECT_LT(compare(wanted).most, kLists);
    parts_.list.erase(parts_.list.begin());
    parts_.list.push_back({one_gaussian({-3.0F, 0.0F, 0.0F})});
    EXPECT_LT(compare(wanted).most, kLists);
  }
}

TEST_F(AmongSurfaces, OpenGlDrawsTheSameEdges) {
  plane_ = sphere_model({.radius = 3.0, .spacing = 0.1});
  parts_.list = {{ball()}, {one_gaussian({2.0F, 1.0F, 0.5F})}};
  RenderSettings wanted = settings("volume");
  wanted.samples = 4;
  wanted.raytrace.samples = 64;
  for (const VolumeDrawingBy by : {VolumeDrawingBy::Shaders, VolumeDrawingBy::Cpu}) {
    wanted.volume.drawn_by = by;
    // 0.0002, by the samples of edges; without the part of pixels beside the surface 0.004.
    EXPECT_LT(compare(wanted).mean, 5e-4);
  }
}

// Two halves of a cloud are the cloud.
TEST_F(AmongSurfaces, SeveralGaussiansAreOneList) {
  plane_ = {};
  GaussianCloud both = one_gaussian({2.0F, 1.0F, 0.5F});
  const GaussianCloud other = one_gaussian({1.0F, 0.0F, 3.0F});
  parts_.list = {{both}, {other}};
  const Image two = draw(settings("volume-reference"));
  both.centres.push_back(other.centres[0]);
  both.scales.push_back(other.scales[0]);
  both.rotations.push_back(other.rotations[0]);
  both.opacities.push_back(other.opacities[0]);
  both.harmonics.push_back(other.harmonics[0]);
  parts_.list = {{both}};
  EXPECT_EQ(values(two, "R"), values(draw(settings("volume-reference")), "R"));
}

TEST_F(AmongSurfaces, EachVolumeHasItsOwnSettings) {
  plane_ = {};
  parts_.list = {{ball(), 0, 0}, {ball(), 0, 1}};
  RenderSettings wanted = settings("volume-reference");
  wanted.volumes = {wanted.volume, wanted.volume};
  wanted.volumes[1].transfer = "none";
  const Image one_is_hidden = draw(wanted);
  parts_.list.pop_back();
  wanted.volumes.clear();
  wanted.volume.visibility = VolumeVisibility::Sorted;  // as several volumes are
  EXPECT_EQ(values(one_is_hidden, "R"), values(draw(wanted), "R"));
}

TEST_F(AmongSurfaces, WhatCannotBeIsSaid) {
  parts_.list = {{ball()}, {one_gaussian({})}};
  RenderSettings wanted = settings("volume-reference");
  const auto error_of = [&] {
    RenderModel model = RenderModel::of(plane_);
    model.add(parts_);
    Progress silent;
    const auto result = render(model, wanted, silent);
    return result ? std::string("no error") : result.error().message;
  };
  wanted.volume.attenuation = Attenuation::Exponential;
  EXPECT_NE(error_of().find("beside a volume take --attenuation linear"), std::string::npos);
  wanted.volume.attenuation = Attenuation::Linear;
  wanted.constants.opacity = 0.5F;
  EXPECT_NE(error_of().find("surfaces beside volumes and 3D Gaussians are opaque"),
            std::string::npos);
}

}  // namespace
}  // namespace relief::test
