// What images of 3D Gaussians are, in all engines that draw them.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <initializer_list>
#include <random>
#include <string>
#include <vector>

#include "common/image/srgb.h"
#include "common/transform.h"
#include "common/volume/gaussian_cloud.h"
#include "common/volume/move.h"
#include "renderer/render.h"

namespace relief {
namespace {

/// The basis function of degree 0.
constexpr float kBand0 = 0.28209479F;

const std::initializer_list<const char*> kEngines{"volume-reference", "volume", "volume-truth"};

/// Without harmonics above degree 0. `colour`: encoded sRGB.
void add_gaussian(GaussianCloud& cloud, glm::vec3 centre, glm::vec3 scales, float opacity,
                  glm::vec3 colour) {
  cloud.centres.push_back(centre);
  cloud.scales.push_back(scales);
  cloud.rotations.emplace_back(1.0F, 0.0F, 0.0F, 0.0F);
  cloud.opacities.push_back(opacity);
  cloud.harmonics.push_back((colour - 0.5F) / kBand0);
}

RenderSettings gaussian_settings(std::uint32_t width = 32, std::uint32_t height = 24) {
  RenderSettings settings;
  settings.width = width;
  settings.height = height;
  settings.camera = {{0.0, 0.0, 4.0}, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, 40.0};
  settings.debug = true;
  return settings;
}

RenderResult draw_gaussians(const GaussianCloud& cloud, RenderSettings settings,
                            const std::string& engine) {
  settings.engine = engine;
  Progress silent;
  RenderModel model;
  model.add(cloud);
  auto result = render(model, settings, silent);
  if (result) return *std::move(result);
  ADD_FAILURE() << engine << ": " << result.error().message;
  return {};
}

/// A channel's values; none, and a failure, if the image has no such channel.
std::vector<float> values_of(const RenderResult& result, const char* name) {
  if (const Channel* const channel = result.image.find(name)) return channel->values;
  ADD_FAILURE() << "no channel " << name;
  return {};
}

/// A channel's value in the pixel beside the image's middle.
float middle(const RenderResult& result, const char* name) {
  const std::vector<float> values = values_of(result, name);
  const std::size_t place =
      std::size_t{result.image.height} / 2 * result.image.width + result.image.width / 2;
  return place < values.size() ? values[place] : 0.0F;
}

// Wide enough that a pixel beside its centre has the opacity of the centre, but for 1e-5.
GaussianCloud one_wide_gaussian(float opacity, float colour) {
  GaussianCloud cloud;
  add_gaussian(cloud, {}, {50.0F, 50.0F, 0.1F}, opacity, glm::vec3(colour));
  return cloud;
}

TEST(GaussianImage, BackgroundIsBlendedAsEncodedSrgb) {
  const GaussianCloud cloud = one_wide_gaussian(0.25F, 0.8F);
  RenderSettings settings = gaussian_settings();
  for (const char* const engine : kEngines) {
    SCOPED_TRACE(engine);
    for (const float behind : {0.0F, 0.2F, 1.0F}) {
      settings.background = glm::vec3(linear_from_srgb(behind));
      settings.volume.gaussians.blend = GaussianBlend::Srgb;
      const float mixed = 0.25F * 0.8F + 0.75F * behind;
      EXPECT_NEAR(srgb_from_linear(middle(draw_gaussians(cloud, settings, engine), "G")), mixed,
                  1e-4);
      settings.volume.gaussians.blend = GaussianBlend::Linear;
      const float light = 0.25F * linear_from_srgb(0.8F) + 0.75F * linear_from_srgb(behind);
      EXPECT_NEAR(middle(draw_gaussians(cloud, settings, engine), "G"), light, 1e-4);
    }
  }
}

// A background brighter than white, as environments are, is not cut where a Gaussian is faint.
TEST(GaussianImage, ABrightBackgroundStaysBright) {
  const GaussianCloud cloud = one_wide_gaussian(0.01F, 0.5F);
  RenderSettings settings = gaussian_settings();
  settings.background = glm::vec3(20.0F);
  const float white = 1.055F * std::pow(20.0F, 1.0F / 2.4F) - 0.055F;
  const float mixed = 0.01F * 0.5F + 0.99F * white;
  for (const char* const engine : kEngines)
    EXPECT_NEAR(middle(draw_gaussians(cloud, settings, engine), "R"), linear_from_srgb(mixed), 1e-2)
        << engine;
}

// What is transparent has the Gaussians' own light: that of no background.
TEST(GaussianImage, WithoutABackgroundAlphaIsKept) {
  const GaussianCloud cloud = one_wide_gaussian(0.25F, 0.8F);
  RenderSettings settings = gaussian_settings();
  settings.background.reset();
  for (const char* const engine : kEngines) {
    const RenderResult drawn = draw_gaussians(cloud, settings, engine);
    EXPECT_NEAR(middle(drawn, "A"), 0.25F, 1e-4) << engine;
    EXPECT_NEAR(middle(drawn, "R"), 0.25F * linear_from_srgb(0.8F), 1e-4) << engine;
  }
}

// A scene that is turned with its camera looks the same, whatever its harmonics.
TEST(GaussianImage, TurnsWithItsCamera) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> unit(-1.0F, 1.0F);
  GaussianCloud cloud;
  for (int k = 0; k < 50; ++k) {
    add_gaussian(cloud, glm::vec3(unit(random), unit(random), unit(random)), {0.3F, 0.1F, 0.02F},
                 0.5F, {});
    cloud.rotations.back() =
        glm::normalize(glm::quat(unit(random), unit(random), unit(random), unit(random)));
  }
  cloud.degree = kMaxHarmonicsDegree;
  cloud.harmonics.clear();
  for (std::size_t c = 0; c < 50 * harmonics_of(kMaxHarmonicsDegree); ++c)
    cloud.harmonics.emplace_back(0.3F * unit(random), 0.3F * unit(random), 0.3F * unit(random));
  RenderSettings settings = gaussian_settings();
  const RenderResult plain = draw_gaussians(cloud, settings, "volume-reference");

  const Transform turn{{1.0, 2.0, -3.0}, rotation_about({1.0, 2.0, 3.0}, 77.0), 1.0};
  ASSERT_TRUE(move_gaussians(cloud, turn));
  settings.camera.eye = moved(turn, settings.camera.eye);
  settings.camera.target = moved(turn, settings.camera.target);
  settings.camera.up = turn.rotation * settings.camera.up;
  const RenderResult turned = draw_gaussians(cloud, settings, "volume-reference");
  const std::vector<float> before = values_of(plain, "R");
  const std::vector<float> after = values_of(turned, "R");
  ASSERT_EQ(before.size(), after.size());
  float most = 0.0F;
  for (std::size_t p = 0; p < before.size(); ++p)
    most = std::max(most, std::abs(before[p] - after[p]));
  // Centres, scales and quaternions are floats. A Gaussian may cross --min-alpha: 1/255.
  EXPECT_LT(most, 0.004F);
}

/// No NaN, nothing infinite, and an alpha that is a share.
void expect_defined(const GaussianCloud& cloud, RenderSettings settings) {
  settings.background.reset();
  for (const char* const engine : {"volume-reference", "volume"}) {
    SCOPED_TRACE(engine);
    const RenderResult drawn = draw_gaussians(cloud, settings, engine);
    for (const char* const name : {"R", "G", "B", "A"}) {
      for (const float value : values_of(drawn, name)) {
        ASSERT_TRUE(std::isfinite(value)) << name;
        ASSERT_GE(value, 0.0F) << name;
      }
    }
    for (const float alpha : values_of(drawn, "A")) ASSERT_LE(alpha, 1.0F);
  }
}

TEST(GaussianExtremes, TenThousandLayers) {
  // Each lets 1 - 1/200 through, so that 1 - 0.995^n is seen; the image ends at 1e-4.
  GaussianCloud cloud;
  for (int k = 0; k < 10000; ++k)
    add_gaussian(cloud, {0.0F, 0.0F, -1e-4F * static_cast<float>(k)}, {50.0F, 50.0F, 1e-5F},
                 1.0F / 200.0F, k < 100 ? glm::vec3(0.9F) : glm::vec3(0.1F));
  RenderSettings settings = gaussian_settings(16, 16);
  settings.background.reset();
  expect_defined(cloud, settings);
  for (const char* const engine : {"volume-reference", "volume"}) {
    const RenderResult drawn = draw_gaussians(cloud, settings, engine);
    const double front = 1.0 - std::pow(0.995, 100.0);
    const double encoded = (0.9 * front + 0.1 * (1.0 - front));
    EXPECT_GT(middle(drawn, "A"), 1.0F - 1.1e-4F) << engine;
    EXPECT_NEAR(srgb_from_linear(middle(drawn, "R")), encoded, 1e-3) << engine;
  }
}

TEST(GaussianExtremes, OpaqueWalls) {
  GaussianCloud cloud;
  for (int k = 0; k < 300; ++k)
    add_gaussian(cloud, {0.0F, 0.0F, -0.01F * static_cast<float>(k)}, {80.0F, 80.0F, 1e-3F}, 1.0F,
                 k == 0 ? glm::vec3(0.7F) : glm::vec3(0.0F, 0.0F, 1.0F));
  RenderSettings settings = gaussian_settings();
  settings.background.reset();
  expect_defined(cloud, settings);
  settings.volume.gaussians.max_alpha = 1.0;
  settings.volume.gaussians.min_transmittance = 0.0;
  expect_defined(cloud, settings);
  for (const char* const engine : {"volume-reference", "volume"}) {
    const RenderResult drawn = draw_gaussians(cloud, settings, engine);
    // The first wall's opacity falls to 1 - 2e-4 at the pixel's place.
    EXPECT_NEAR(srgb_from_linear(middle(drawn, "B")), 0.7, 1e-3) << engine;
    EXPECT_NEAR(middle(drawn, "A"), 1.0F, 1e-6F) << engine;
  }
}

TEST(GaussianExtremes, HugeAndTinyScales) {
  std::mt19937 random(9);
  std::uniform_real_distribution<float> unit(-1.0F, 1.0F);
  GaussianCloud cloud;
  for (int k = 0; k < 300; ++k) {
    glm::vec3 scales(0.0F);
    // 1e-38 to 1e38: variances overflow and underflow floats, and their products doubles.
    for (glm::length_t a = 0; a < 3; ++a) scales[a] = std::pow(10.0F, 38.0F * unit(random));
    add_gaussian(cloud, {unit(random), unit(random), unit(random)}, scales,
                 0.5F + 0.5F * unit(random), {0.9F, 0.5F, 0.1F});
    cloud.rotations.back() =
        glm::normalize(glm::quat(unit(random), unit(random), unit(random), unit(random)));
  }
  RenderSettings settings = gaussian_settings();
  for (const VolumeFilter filter : {VolumeFilter::Automatic, VolumeFilter::Ewa,
                                    VolumeFilter::UniformScaling, VolumeFilter::Unfiltered}) {
    SCOPED_TRACE(static_cast<int>(filter));
    settings.volume.filter = filter;
    expect_defined(cloud, settings);
  }
}

TEST(GaussianExtremes, FarAndBright) {
  GaussianCloud cloud;
  for (const float far : {1e-30F, 1.0F, 1e19F, 1e30F, 3e38F}) {
    for (const float sign : {-1.0F, 1.0F}) {
      add_gaussian(cloud, {sign * far, -sign * far, sign * far}, glm::vec3(far), 0.9F,
                   glm::vec3(1e30F));
    }
  }
  RenderSettings settings = gaussian_settings();
  expect_defined(cloud, settings);
  settings.volume.gaussians.blend = GaussianBlend::Linear;
  expect_defined(cloud, settings);
  settings.camera.orthographic_height = 4.0;
  expect_defined(cloud, settings);
}

TEST(GaussianExtremes, EyeInside) {
  GaussianCloud cloud;
  for (const float size : {1e-3F, 0.1F, 1.0F, 100.0F}) {
    add_gaussian(cloud, {0.0F, 0.0F, 4.0F}, glm::vec3(size), 0.6F, glm::vec3(0.5F));
    add_gaussian(cloud, {0.0F, 0.0F, 4.0F - 1e-6F}, glm::vec3(size), 0.6F, glm::vec3(0.5F));
    add_gaussian(cloud, {0.0F, 0.0F, 3.9F}, glm::vec3(size), 0.6F, glm::vec3(0.5F));
    add_gaussian(cloud, {50.0F, 0.0F, 3.7F}, glm::vec3(size), 0.6F, glm::vec3(0.5F));
  }
  RenderSettings settings = gaussian_settings();
  expect_defined(cloud, settings);
  settings.volume.gaussians.near = 0.0;
  settings.volume.gaussians.jacobian_clamp = 0.0;
  expect_defined(cloud, settings);
}

TEST(GaussianExtremes, AMillionKernels) {
  GaussianCloud cloud;
  constexpr std::uint32_t kSide = 100;
  for (std::uint32_t k = 0; k < kSide * kSide * kSide; ++k) {
    const glm::vec3 node(k % kSide, k / kSide % kSide, k / kSide / kSide);
    add_gaussian(cloud, node / 50.0F - 1.0F, glm::vec3(0.005F), 0.3F, node / 100.0F);
  }
  expect_defined(cloud, gaussian_settings(24, 24));
}

}  // namespace
}  // namespace relief
