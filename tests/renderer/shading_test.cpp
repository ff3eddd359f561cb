// Shading against values computed by hand.
#include "renderer/shading.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

namespace relief {
namespace {

/// One light from +Z and a little from everywhere.
Lighting one_light(Material material) {
  Lighting lighting{{}, 1, nullptr, {material}};
  lighting.frame.light_place[0] = {0.0F, 0.0F, 1.0F, 0.0F};
  lighting.frame.light_colour[0] = {1.0F, 0.5F, 0.25F, 0.0F};
  lighting.frame.light_ambient = {0.1F, 0.1F, 0.1F, 0.0F};
  return lighting;
}

const glm::vec3 kDown(0.0F, 0.0F, -1.0F);

/// What a grey surface shows straight from above.
glm::vec3 shade_grey(const Lighting& lighting, glm::vec3 normal, glm::vec3 place = {}) {
  return shade(lighting, 0, {glm::vec3(0.5F), normal, kDown, place});
}

/// A unit vector that leans from +Z toward +X.
glm::vec3 leaning(double degrees) {
  const double angle = degrees * std::acos(-1.0) / 180.0;
  return {std::sin(angle), 0.0, std::cos(angle)};
}

void expect_near(glm::vec3 seen, glm::vec3 expected, const char* what) {
  EXPECT_LT(glm::distance(seen, expected), 1e-6F)
      << what << " " << seen.x << " " << seen.y << " " << seen.z;
}

TEST(Shading, UnlitIsTheColour) {
  const glm::vec3 albedo(0.1F, 0.7F, 0.3F);
  EXPECT_EQ(shade(one_light(Material::Unlit), 0, {albedo, kDown, kDown, {}}), albedo);
}

TEST(Shading, LitFacingTheLight) {
  // Diffuse 0.5 (0.1 + light), and the highlight's middle: 0.25 light.
  expect_near(shade_grey(one_light(Material::Lit), leaning(0.0)), {0.8F, 0.425F, 0.2375F},
              "facing");
}

TEST(Shading, LitAtSixtyDegreesHasNoHighlight) {
  // cos 60 = 0.5; the reflection points away from the light.
  expect_near(shade_grey(one_light(Material::Lit), leaning(60.0)), {0.3F, 0.175F, 0.1125F},
              "60 degrees");
}

TEST(Shading, HighlightFallsOffWithTheFortiethPower) {
  // The normal leans by 5 degrees, the reflection by 10.
  const double diffuse = 0.5 * (0.1 + std::cos(std::acos(-1.0) / 36.0));
  const double highlight = 0.25 * std::pow(std::cos(std::acos(-1.0) / 18.0), 40.0);
  const glm::vec3 seen = shade_grey(one_light(Material::Lit), leaning(5.0));
  EXPECT_NEAR(seen.x, diffuse + highlight, 2e-6);  // 40 times a float's rounding
}

TEST(Shading, BackSidesAreLitAsFronts) {
  for (const double lean : {0.0, 40.0}) {
    expect_near(shade_grey(one_light(Material::Lit), -leaning(lean)),
                shade_grey(one_light(Material::Lit), leaning(lean)), "back");
  }
}

TEST(Shading, NormalsThatLeanALittleAwayAreBentToGrazing) {
  // 100 degrees from the eye: bent to 90, where a grazing ray goes straight on; only ambient light
  // is left.
  expect_near(shade_grey(one_light(Material::Lit), leaning(100.0)), glm::vec3(0.05F), "bent");
}

TEST(Shading, APointLightFallsWithTheSquareOfItsDistance) {
  Lighting lighting = one_light(Material::Lit);
  // 3 units to the side and 4 above the surface, which is 10 units below the eye.
  lighting.frame.light_place[0] = {3.0F, 0.0F, -6.0F, 1.0F};
  lighting.frame.light_colour[0] = {50.0F, 25.0F, 0.0F, 0.0F};
  // 5 away, so that 1/25 is left, at an angle whose cosine is 4/5. The reflection goes straight up:
  // 0.8^40 of the highlight.
  const float diffuse = 50.0F / 25.0F * 0.8F;
  const float highlight = 0.25F * 2.0F * std::pow(0.8F, 40.0F);
  const glm::vec3 seen = shade_grey(lighting, leaning(0.0), {0.0F, 0.0F, -10.0F});
  expect_near(
      seen,
      {0.5F * (0.1F + diffuse) + highlight, 0.5F * (0.1F + diffuse / 2) + highlight / 2, 0.05F},
      "point light");
}

TEST(Shading, APointLightOnTheSurfaceIsFinite) {
  Lighting lighting = one_light(Material::Lit);
  lighting.frame.light_place[0] = {0.0F, 0.0F, -10.0F, 1.0F};
  lighting.frame.light_colour[0] = glm::vec4(1e12F);
  for (const float away : {0.0F, 1e-30F, 1e-6F}) {
    const glm::vec3 seen = shade_grey(lighting, leaning(0.0), {0.0F, 0.0F, -10.0F - away});
    // The brightest light, diffuse and as highlight.
    EXPECT_LE(seen.x, 0.05F + 0.75F * shared::kBrightestLight) << away;
    EXPECT_GE(seen.x, 0.05F) << away;
  }
}

TEST(Shading, EveryLightCounts) {
  Lighting lighting = one_light(Material::Lit);
  lighting.lights = shared::kMostLights;
  for (int i = 0; i < shared::kMostLights; ++i) {
    lighting.frame.light_place[i] = {0.0F, 0.0F, 1.0F, 0.0F};
    lighting.frame.light_colour[i] = glm::vec4(static_cast<float>(i + 1));
  }
  // 1 + 2 + ... + 16 = 136, diffuse by the albedo of 0.5 and a quarter as highlight.
  EXPECT_NEAR(shade_grey(lighting, leaning(0.0)).x, 0.05 + 136 * 0.75, 1e-4);
}

TEST(Shading, MirrorReflectsTheEnvironment) {
  CubeMap cube;
  cube.size = 1;
  for (std::size_t face = 0; face < 6; ++face)
    cube.faces[face] = {glm::vec3(static_cast<float>(face))};
  // At 45 degrees what comes straight down goes to +X, from a level mirror it goes back to +Z.
  Lighting lighting = one_light(Material::Mirror);
  lighting.cube = &cube;
  const auto face_seen = [&lighting](double degrees) {
    return shade_grey(lighting, leaning(degrees)).x;
  };
  EXPECT_NEAR(face_seen(45.0), 0.0, 1e-5);
  EXPECT_NEAR(face_seen(0.0), 4.0, 1e-5);
}

}  // namespace
}  // namespace relief
