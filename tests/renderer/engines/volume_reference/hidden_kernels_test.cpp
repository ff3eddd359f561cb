// Kernels are placed in batches, front to back, and not at all where nothing more is seen.
#include <gtest/gtest.h>

#include "common/volume/gaussian_cloud.h"
#include "renderer/render.h"

namespace relief {
namespace {

/// Square layers across z of side 4, front to back from z = 0, each of 100 x 100 opaque Gaussians.
void add_layers(GaussianCloud& cloud, int layers, glm::vec3 harmonic) {
  for (int l = 0; l < layers; ++l) {
    const auto z = -0.01F * static_cast<float>(cloud.size() / 10000);
    for (int i = 0; i < 10000; ++i) {
      cloud.centres.emplace_back(static_cast<float>(i % 100) * 0.04F - 1.98F,
                                 static_cast<float>(i / 100) * 0.04F - 1.98F, z);
      cloud.scales.emplace_back(0.05F);
      cloud.rotations.emplace_back(1.0F, 0.0F, 0.0F, 0.0F);
      cloud.opacities.push_back(0.95F);
      cloud.harmonics.push_back(harmonic);
    }
  }
}

RenderResult draw(const GaussianCloud& cloud) {
  RenderSettings settings;
  settings.engine = "volume-reference";
  settings.width = 80;
  settings.height = 64;
  settings.camera = {{0.0, 0.0, 4.0}, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, 40.0};
  Progress silent;
  RenderModel model;
  model.add(cloud);
  auto result = render(model, settings, silent);
  if (result) return *std::move(result);
  ADD_FAILURE() << result.error().message;
  return {};
}

TEST(HiddenKernels, ChangeNothing) {
  GaussianCloud cloud;
  add_layers(cloud, 5, glm::vec3(0.3F, -0.2F, 0.1F));
  const RenderResult wall = draw(cloud);
  ASSERT_EQ(wall.covered_pixels, 80U * 64U);
  add_layers(cloud, 15, glm::vec3(-0.5F, 0.8F, 0.6F));  // three batches and more in all
  const RenderResult all = draw(cloud);
  EXPECT_EQ(all.fragments, wall.fragments) << "what is behind the wall is not evaluated";
  for (const char* const name : {"R", "G", "B", "A"})
    EXPECT_EQ(all.image.find(name)->values, wall.image.find(name)->values) << name;
}

TEST(HiddenKernels, AreSeenWhereTheWallEnds) {
  GaussianCloud cloud;
  add_layers(cloud, 5, glm::vec3(0.3F, -0.2F, 0.1F));
  for (std::size_t k = 0; k < cloud.size(); ++k) {
    if (cloud.centres[k].x > 0.0F) cloud.opacities[k] = 0.001F;  // fainter than what is drawn
  }
  const RenderResult half = draw(cloud);
  add_layers(cloud, 15, glm::vec3(-0.5F, 0.8F, 0.6F));
  const RenderResult all = draw(cloud);
  EXPECT_LT(half.covered_pixels, 80U * 40U);
  EXPECT_EQ(all.covered_pixels, 80U * 64U);
  EXPECT_GT(all.fragments, half.fragments);
}

}  // namespace
}  // namespace relief
