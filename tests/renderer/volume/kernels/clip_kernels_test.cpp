// What lies outside of a clip box is not drawn, by any engine of volumes.
#include "renderer/volume/kernels/clip_kernels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "common/volume/gaussian_cloud.h"
#include "common/volume/scalar_volume.h"
#include "renderer/render.h"
#include "renderer/volume/kernels/volume_kernels.h"

namespace relief {
namespace {

/// A cube of 21^3 nodes from -1 to 1 whose values are all 1.
ScalarVolume full_cube() {
  ScalarVolume volume;
  volume.size = glm::uvec3(21);
  volume.placement = RegularGrid{glm::dvec3(-1.0), glm::dmat3(0.1)};
  volume.values.assign(nodes_of(volume), 1.0F);
  return volume;
}

RenderSettings settings_along_z(const char* engine) {
  RenderSettings settings;
  settings.engine = engine;
  settings.width = 80;
  settings.height = 80;
  settings.camera = {{0.0, 0.0, 10.0}, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, 45.0, 4.0};
  settings.background.reset();
  settings.material = Material::Unlit;
  return settings;
}

template <class Model>
Image drawn(const Model& model, const RenderSettings& settings) {
  Progress silent;
  RenderModel form;
  form.add(model);
  auto result = render(form, settings, silent);
  if (result) return std::move(result->image);
  ADD_FAILURE() << result.error().message;
  return {};
}

float alpha_at(const Image& image, std::size_t x, std::size_t y) {
  return image.find("A")->values[y * image.width + x];
}

TEST(ClipKernels, KeepsThoseInsideWithAllThatTheyHave) {
  KernelCloud cloud;
  cloud.size = {5, 1, 1};
  for (std::uint32_t k = 0; k < 5; ++k) {
    const auto f = static_cast<float>(k);
    cloud.centres.emplace_back(k, 0.0, 0.0);
    cloud.variances.push_back({f + 1.0, 0, 0, 1, 0, 1});
    cloud.weights.push_back(f);
    cloud.colours.emplace_back(f);
    cloud.normals.emplace_back(0.0F, 0.0F, f);
    cloud.nodes.push_back(k);
  }
  clip_kernels(cloud, {{1.0, -1.0, -1.0}, {3.0, 1.0, 1.0}});
  ASSERT_EQ(cloud.count(), 3U);
  EXPECT_EQ(cloud.nodes, (std::vector<std::uint32_t>{1, 2, 3}));
  EXPECT_EQ(cloud.weights, (std::vector<float>{1, 2, 3}));
  EXPECT_EQ(cloud.colours[2], glm::vec3(3.0F));
  EXPECT_EQ(cloud.normals[0].z, 1.0F);
  EXPECT_EQ(cloud.variance(1).xx, 3.0);
  EXPECT_TRUE(cloud.is_surface.empty());
}

TEST(ClipKernels, TheVarianceOfAllStaysEvenIfOneKernelOrNoneDoes) {
  KernelCloud cloud;
  cloud.centres = {glm::dvec3(0.0)};
  cloud.weights = {1.0F};
  cloud.variances = {{2, 0, 0, 2, 0, 2}};
  clip_kernels(cloud, {glm::dvec3(1.0), glm::dvec3(2.0)});
  EXPECT_EQ(cloud.count(), 0U);
  EXPECT_EQ(cloud.variances.size(), 1U);
}

// The right half of the image is that of x above 0. Kernels are 0.1 wide, 2 pixels.
TEST(ClipBoxes, EachEngineCutsAVolumeAtTheSamePlace) {
  const ScalarVolume volume = full_cube();
  for (const char* const engine : {"volume", "volume-reference", "volume-truth"}) {
    SCOPED_TRACE(engine);
    RenderSettings settings = settings_along_z(engine);
    const Image whole = drawn(volume, settings);
    settings.volume.clip = parse_clip_box("0,0%,0%,100%,100%,100%");
    const Image cut = drawn(volume, settings);
    EXPECT_EQ(alpha_at(whole, 50, 40), alpha_at(cut, 50, 40)) << "far inside nothing changes";
    EXPECT_GT(alpha_at(whole, 30, 40), 0.9F);
    // 4.75 standard deviations outside: 1e-6 of a kernel's integral is beyond, and the truth has no
    // cutoff.
    EXPECT_LT(alpha_at(cut, 30, 40), 1e-3F);
  }
}

TEST(ClipBoxes, TheInterpolatedFieldEndsAtTheBoxItself) {
  RenderSettings settings = settings_along_z("volume-truth");
  settings.options.insert_or_assign("truth", std::string("field"));
  settings.volume.clip = parse_clip_box("0,-0.5,0%,1,0.5,100%");
  const Image cut = drawn(full_cube(), settings);
  // A pixel is 0.05 wide: x from 0 to 1 are the pixels 40 to 59, y from -0.5 to 0.5 are 30 to 49.
  EXPECT_EQ(alpha_at(cut, 39, 40), 0.0F);
  EXPECT_GT(alpha_at(cut, 40, 40), 0.9F);
  EXPECT_GT(alpha_at(cut, 59, 30), 0.9F);
  EXPECT_EQ(alpha_at(cut, 50, 29), 0.0F);
  EXPECT_EQ(alpha_at(cut, 50, 50), 0.0F);
}

// Along the ray: half of the volume is half as deep.
TEST(ClipBoxes, TheFieldIsCutAlongTheRay) {
  RenderSettings settings = settings_along_z("volume-truth");
  settings.options.insert_or_assign("truth", std::string("field"));
  const ScalarVolume volume = full_cube();
  const auto depth = [&](const char* box) {
    if (box != nullptr) settings.volume.clip = parse_clip_box(box);
    return -std::log(1.0 - static_cast<double>(alpha_at(drawn(volume, settings), 40, 40)));
  };
  settings.volume.transfer = "mr";
  const double whole = depth(nullptr);
  ASSERT_TRUE(std::isfinite(whole));
  // Alphas are floats: 1e-7 of 0.9 and more.
  EXPECT_NEAR(depth("0%,0%,0,100%,100%,100%"), 0.5 * whole, 1e-4 * whole);
  EXPECT_NEAR(depth("0%,0%,75%,100%,100%,100%"), 0.25 * whole, 1e-4 * whole);
}

TEST(ClipBoxes, OfGaussiansAreOfTheirCentres) {
  GaussianCloud cloud;
  for (const float x : {-1.0F, 0.0F, 1.0F}) {
    cloud.centres.emplace_back(x, 0.0F, 0.0F);
    cloud.scales.emplace_back(0.1F);
    cloud.rotations.emplace_back(1.0F, 0.0F, 0.0F, 0.0F);
    cloud.opacities.push_back(0.9F);
    cloud.harmonics.emplace_back(1.0F, 0.0F, -1.0F);
  }
  for (const char* const engine : {"volume", "volume-reference", "volume-truth"}) {
    SCOPED_TRACE(engine);
    RenderSettings settings = settings_along_z(engine);
    const Image whole = drawn(cloud, settings);
    settings.volume.clip = parse_clip_box("-0.5,-1,-1,0.5,1,1");
    const Image cut = drawn(cloud, settings);
    EXPECT_GT(alpha_at(cut, 40, 40), 0.7F);
    EXPECT_EQ(alpha_at(cut, 40, 40), alpha_at(whole, 40, 40));
    EXPECT_EQ(alpha_at(cut, 20, 40), 0.0F);
    EXPECT_GT(alpha_at(whole, 20, 40), 0.7F);
    EXPECT_EQ(alpha_at(cut, 60, 40), 0.0F);
  }
}

TEST(ClipBoxes, ASurfaceIsCutToo) {
  ScalarVolume volume = full_cube();
  for (std::size_t n = 0; n < volume.values.size(); ++n)
    volume.values[n] = static_cast<float>(n / 441);  // z
  RenderSettings settings = settings_along_z("volume-reference");
  settings.volume.transfer = "none";
  settings.volume.iso = 10.25;
  settings.volume.clip = parse_clip_box("0,0%,0%,100%,100%,100%");
  const Image cut = drawn(volume, settings);
  EXPECT_GT(alpha_at(cut, 50, 40), 0.8F);
  EXPECT_LT(alpha_at(cut, 30, 40), 1e-6F);
}

// What is cut off and put back leaves nothing behind: kernels are made again.
TEST(ClipBoxes, DoNotStay) {
  Progress silent;
  const ScalarVolume volume = full_cube();
  RenderModel form;
  form.add(volume);
  std::vector<RenderSettings> views(3, settings_along_z("volume-reference"));
  views[1].volume.clip = parse_clip_box("0,0,0,1,1,1");
  std::vector<std::vector<float>> alphas;
  const auto keep = [&](std::size_t /*view*/, RenderResult result) -> Status {
    alphas.push_back(result.image.find("A")->values);
    return {};
  };
  const Status rendered = render_views(form, views, keep, silent);
  ASSERT_TRUE(rendered) << rendered.error().message;
  EXPECT_EQ(alphas[0], alphas[2]);
  EXPECT_NE(alphas[0], alphas[1]);
}

TEST(ClipBoxes, ThatHoldNothingAreAnError) {
  Progress silent;
  const ScalarVolume volume = full_cube();
  RenderModel form;
  form.add(volume);
  for (const char* const engine : {"volume", "volume-reference", "volume-truth"}) {
    RenderSettings settings = settings_along_z(engine);
    settings.volume.clip = parse_clip_box("2,0,0,3,1,1");
    for (const char* const truth : {"kernels", "field"}) {
      settings.options.insert_or_assign("truth", std::string(truth));
      const auto result = render(form, settings, silent);
      ASSERT_FALSE(result) << engine;
      EXPECT_NE(result.error().message.find("holds nothing of the model"), std::string::npos)
          << result.error().message;
    }
  }
}

}  // namespace
}  // namespace relief
