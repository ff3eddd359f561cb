// Coarser kernels of a grid that is far away, and their images.
#include "renderer/volume/coarse_kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "renderer/render.h"
#include "renderer/volume/kernels/volume_kernels.h"
#include "tests/renderer/images.h"

namespace relief {
namespace {

using test::psnr;

/// A ball whose values fall from 1 in the middle to 0, over the box from -1 to 1.
ScalarVolume soft_ball(std::uint32_t nodes) {
  ScalarVolume volume;
  volume.size = glm::uvec3(nodes);
  const double step = 2.0 / (nodes - 1);
  volume.placement = RegularGrid{glm::dvec3(-1.0), glm::dmat3(step)};
  for (std::size_t n = 0; n < nodes_of(volume); ++n) {
    const glm::dvec3 p =
        glm::dvec3(-1.0) + step * glm::dvec3(n % nodes, n / nodes % nodes, n / nodes / nodes);
    volume.values.push_back(static_cast<float>(std::max(0.0, 1.0 - glm::length(p))));
  }
  return volume;
}

KernelCloud fine_kernels(const ScalarVolume& volume) {
  const TransferFunction function{
      {{0.0, {1.0F, 0.0F, 0.0F}}, {1.0, {0.0F, 1.0F, 0.0F}}}, {{0.0, 0.0}, {1.0, 0.3}}, {}, 0.1};
  return kernels_of_volume(volume, function, {}, Progress());
}

TEST(CoarseKernels, KeepTheSumsOfWeightsPlacesAndColours) {
  const ScalarVolume volume = soft_ball(21);
  const auto& grid = std::get<RegularGrid>(volume.placement);
  const KernelCloud fine = fine_kernels(volume);
  for (const int level : {1, 2, 3}) {
    const KernelCloud coarse = coarse_kernels(fine, grid, level, Attenuation::Exponential);
    EXPECT_LT(coarse.count() * (level == 1 ? 5 : 20), fine.count());
    const auto sums = [](const KernelCloud& cloud) {
      glm::dvec4 sum(0.0);
      for (std::size_t k = 0; k < cloud.count(); ++k) {
        const double weight = cloud.weights[k];
        sum += weight * glm::dvec4(1.0, cloud.centres[k].x + cloud.centres[k].y * 0.5,
                                   cloud.centres[k].z, cloud.colours[k].g);
      }
      return sum;
    };
    // Weights and colours are floats.
    EXPECT_LT(glm::distance(sums(coarse), sums(fine)), 1e-6 * glm::length(sums(fine))) << level;
  }
}

TEST(CoarseKernels, KeepTheSecondMomentOfEqualKernels) {
  ScalarVolume volume;
  volume.size = glm::uvec3(8);
  volume.placement = RegularGrid{glm::dvec3(0.0), {{0.5, 0.0, 0.0}, {0.2, 1.0, 0.0}, {0, 0, 2}}};
  volume.values.assign(nodes_of(volume), 0.5F);
  const auto moment = [](const KernelCloud& cloud) {
    glm::dmat3 sum(0.0);
    double weights = 0.0;
    for (std::size_t k = 0; k < cloud.count(); ++k) {
      const double weight = cloud.weights[k];
      weights += weight;
      sum += weight *
             (glm::outerProduct(cloud.centres[k], cloud.centres[k]) + matrix_of(cloud.variance(k)));
    }
    return sum / weights;
  };
  const KernelCloud fine = fine_kernels(volume);
  const KernelCloud coarse =
      coarse_kernels(fine, std::get<RegularGrid>(volume.placement), 3, Attenuation::Exponential);
  ASSERT_EQ(coarse.count(), 1U);
  const glm::dmat3 off = moment(coarse) - moment(fine);
  for (glm::length_t c = 0; c < 3; ++c) EXPECT_LT(glm::length(off[c]), 1e-5);
}

// Opacities of layers are their optical depths: two of 0.4 let 0.36 through.
TEST(CoarseKernels, OneLayerLetsThroughWhatTwoDid) {
  ScalarVolume volume;
  volume.size = glm::uvec3(4);
  volume.placement = RegularGrid{};
  volume.values.assign(nodes_of(volume), 1.0F);
  const TransferFunction function{{{0.0, glm::vec3(1.0F)}}, {{0.0, 1.0 - std::exp(-0.4)}}, {}, 1.0};
  const KernelCloud fine = kernels_of_volume(volume, function, {}, Progress());
  const KernelCloud coarse = coarse_kernels(fine, RegularGrid{}, 1, Attenuation::Linear);
  ASSERT_EQ(coarse.count(), 8U);
  // A kernel of 2 x 2 x 2 units is 4 units wide across the ray.
  EXPECT_NEAR(static_cast<double>(coarse.weights[0]) / 4.0, 1.0 - 0.6 * 0.6, 1e-6);
}

RenderSettings far_view(double distance) {
  RenderSettings settings;
  settings.engine = "volume-reference";
  settings.width = 64;
  settings.height = 64;
  settings.camera = {distance * glm::dvec3(0.3, 0.25, 1.0), {0, 0, 0}, {0, 1, 0}, 30.0};
  settings.background.reset();
  return settings;
}

TEST(CoarseKernels, TheLevelFollowsFromTheDistance) {
  const ScalarVolume volume = soft_ball(129);
  const auto& grid = std::get<RegularGrid>(volume.placement);
  const auto level = [&](const RenderSettings& settings) {
    return coarse_level(volume, grid,
                        make_view(settings.camera, settings.width, settings.height, 1e-6), 1.0);
  };
  // A node is 1/64 wide, and a unit 119 pixels at a distance of 1. The nearest corner is 1.5 units
  // nearer than the middle.
  EXPECT_EQ(level(far_view(3.0)), 0);   // 1.1 pixels apart
  EXPECT_EQ(level(far_view(8.0)), 1);   // 0.26
  EXPECT_EQ(level(far_view(15.0)), 2);  // 0.13
  EXPECT_EQ(level(far_view(0.5)), 0) << "the eye is within";
  EXPECT_EQ(level(far_view(1e9)), 6) << "of 129 nodes two are left";
  RenderSettings parallel = far_view(4.0);
  parallel.camera.orthographic_height = 8.0;  // 8 pixels for a unit
  EXPECT_EQ(level(parallel), 3);
}

TEST(CoarseKernels, ImagesFromAfarAgree) {
  const ScalarVolume volume = soft_ball(97);
  RenderModel form;
  form.add(volume);
  Progress silent;
  for (const Attenuation attenuation : {Attenuation::Linear, Attenuation::Exponential}) {
    RenderSettings settings = far_view(12.0);
    settings.volume.attenuation = attenuation;
    const auto fine = render(form, settings, silent);
    settings.volume.pixels_per_node = 1.0;
    const auto coarse = render(form, settings, silent);
    ASSERT_TRUE(fine && coarse);
    EXPECT_LT(4 * *coarse->fragments, *fine->fragments);
    const double apart = psnr(coarse->image, fine->image);
    RecordProperty("psnr", std::to_string(apart));
    EXPECT_GT(apart, 35.0) << static_cast<int>(attenuation);
    settings.engine = "volume";
    for (const VolumeDrawingBy by : {VolumeDrawingBy::Shaders, VolumeDrawingBy::Cpu}) {
      settings.volume.drawn_by = by;
      const auto drawn = render(form, settings, silent);
      ASSERT_TRUE(drawn);
      // Lists and the CPU drawing have the reference's sums, in single precision.
      EXPECT_GT(psnr(drawn->image, coarse->image), 80.0);
    }
  }
}

TEST(CoarseKernels, AreOffByDefaultAndForSurfaces) {
  EXPECT_EQ(VolumeSettings().pixels_per_node, 0.0);
  const ScalarVolume volume = soft_ball(33);
  RenderModel form;
  form.add(volume);
  Progress silent;
  RenderSettings settings = far_view(20.0);
  settings.volume.iso = 0.5;
  const auto fine = render(form, settings, silent);
  settings.volume.pixels_per_node = 1.0;
  const auto same = render(form, settings, silent);
  ASSERT_TRUE(fine && same);
  EXPECT_EQ(fine->image.find("R")->values, same->image.find("R")->values);
}

}  // namespace
}  // namespace relief
