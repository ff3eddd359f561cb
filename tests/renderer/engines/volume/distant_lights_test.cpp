// Lighting of kLanes kernels at once against shading of one.
#include "renderer/engines/volume/cpu/distant_lights.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <random>
#include <vector>

#include "renderer/shading/shading.h"

namespace relief::volume::cpu {
namespace {

Lighting three_lights() {
  Lighting lighting;
  lighting.lights = 3;
  lighting.frame.light_ambient = {0.06F, 0.05F, 0.04F, 0.25F};
  const glm::vec3 toward[] = {{0.0F, 0.6F, 0.8F}, {1.0F, 0.0F, 0.0F}, {0.0F, 0.0F, -1.0F}};
  for (int i = 0; i < 3; ++i) {
    lighting.frame.light_position[i] = glm::vec4(toward[i], 0.0F);
    lighting.frame.light_colour[i] = {0.9F, 0.5F + 0.1F * static_cast<float>(i), 0.3F, 0.0F};
  }
  lighting.materials = {{}};
  return lighting;
}

Vectors lanes_of(const std::vector<glm::vec3>& values) {
  Vectors lanes;
  for (int i = 0; i < kLanes; ++i) {
    const glm::vec3& value = values[static_cast<std::size_t>(i)];
    lanes.x[i] = value.x;
    lanes.y[i] = value.y;
    lanes.z[i] = value.z;
  }
  return lanes;
}

TEST(DistantLights, LightAsShadingDoes) {
  const Lighting lighting = three_lights();
  std::mt19937 random(1);
  std::normal_distribution<float> normal;
  const auto direction = [&] {
    return glm::normalize(glm::vec3(normal(random), normal(random), normal(random)));
  };
  for (int round = 0; round < 1000; ++round) {
    std::vector<glm::vec3> normals;
    std::vector<glm::vec3> rays;
    std::vector<glm::vec3> albedos;
    for (int i = 0; i < kLanes; ++i) {
      normals.push_back(direction());
      rays.push_back(direction());
      albedos.push_back(glm::abs(direction()));
    }
    const Vectors lit_lanes =
        lit(lighting.frame, lighting.lights, lanes_of(albedos), lanes_of(normals), lanes_of(rays));
    for (int i = 0; i < kLanes; ++i) {
      const auto at = static_cast<std::size_t>(i);
      // At these a rounding decides which side is seen.
      const float away = glm::dot(normals[at], rays[at]);
      if (std::abs(away) < 1e-5F || std::abs(away - shared::kBackSide) < 1e-5F) continue;
      const glm::vec3 expected =
          shade(lighting, 0, {.albedo = albedos[at], .normal = normals[at], .ray = rays[at]});
      // A highlight's x^40 makes of 6e-8 in x forty times that, and a unit normal has as much.
      EXPECT_NEAR(lit_lanes.x[i], expected.x, 2e-5F);
      EXPECT_NEAR(lit_lanes.y[i], expected.y, 2e-5F);
      EXPECT_NEAR(lit_lanes.z[i], expected.z, 2e-5F);
    }
  }
}

TEST(DistantLights, NothingIsLitWithoutANormal) {
  const Lighting lighting = three_lights();
  const Vectors albedo{all_of(0.3F), all_of(0.2F), all_of(0.1F)};
  const Vectors ray{all_of(0.0F), all_of(0.0F), all_of(-1.0F)};
  const Vectors shown = lit(lighting.frame, lighting.lights, albedo, Vectors{}, ray);
  for (int i = 0; i < kLanes; ++i) {
    EXPECT_EQ(shown.x[i], 0.3F);
    EXPECT_EQ(shown.y[i], 0.2F);
    EXPECT_EQ(shown.z[i], 0.1F);
  }
}

}  // namespace
}  // namespace relief::volume::cpu
