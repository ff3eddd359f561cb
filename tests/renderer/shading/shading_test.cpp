// Shading against values computed by hand.
#include "renderer/shading/shading.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "shaders/include/shading.h"

namespace relief {
namespace {

/// One light from +Z and a little from everywhere.
Lighting one_light(Material material) {
  Lighting lighting{{}, 1, {{{material, {}}, nullptr}}};
  lighting.frame.light_position[0] = {0.0F, 0.0F, 1.0F, 0.0F};
  lighting.frame.light_colour[0] = {1.0F, 0.5F, 0.25F, 0.0F};
  lighting.frame.light_ambient = {0.1F, 0.1F, 0.1F, 0.25F};
  return lighting;
}

const glm::vec3 kDown(0.0F, 0.0F, -1.0F);

/// What a grey surface shows straight from above.
glm::vec3 shade_grey(const Lighting& lighting, glm::vec3 normal, glm::vec3 position = {}) {
  return shade(lighting, 0, {glm::vec3(0.5F), normal, kDown, position});
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
  lighting.frame.light_position[0] = {3.0F, 0.0F, -6.0F, 1.0F};
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
  lighting.frame.light_position[0] = {0.0F, 0.0F, -10.0F, 1.0F};
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
  lighting.lights = shared::kMaxLights;
  for (int i = 0; i < shared::kMaxLights; ++i) {
    lighting.frame.light_position[i] = {0.0F, 0.0F, 1.0F, 0.0F};
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
  lighting.materials[0].environment.cube = &cube;
  const auto face_seen = [&lighting](double degrees) {
    return shade_grey(lighting, leaning(degrees)).x;
  };
  EXPECT_NEAR(face_seen(45.0), 0.0, 1e-5);
  EXPECT_NEAR(face_seen(0.0), 4.0, 1e-5);
}

/// What glass of that index makes of straight down on +Z, or on a normal that leans.
shared::SplitRay split_at(double degrees, float ior) {
  return shared::split_ray(leaning(degrees), kDown, ior);
}

TEST(Glass, ReflectsAndRefractsAFacingRayStraight) {
  // ((n - 1) / (n + 1))^2, which is 0.04 of 1.5.
  const shared::SplitRay split = split_at(0.0, 1.5F);
  EXPECT_NEAR(split.reflectance, 0.04F, 1e-6);
  EXPECT_NEAR(split.path, 1.0F, 1e-6);
  expect_near(split.refracted, kDown, "refracted");
  expect_near(split.reflected, -kDown, "reflected");
}

TEST(Glass, BendsRaysBySnellsLaw) {
  for (const double degrees : {10.0, 40.0, 80.0}) {
    const double inside = std::asin(std::sin(degrees * std::acos(-1.0) / 180.0) / 1.5);
    const shared::SplitRay split = split_at(degrees, 1.5F);
    EXPECT_NEAR(glm::dot(split.refracted, -leaning(degrees)), std::cos(inside), 1e-6) << degrees;
    EXPECT_NEAR(glm::length(split.refracted), 1.0, 1e-6) << degrees;
    EXPECT_NEAR(split.path, std::cos(inside), 1e-6) << degrees;
    // In the plane of ray and normal, on the other side of the normal than where it came from.
    EXPECT_NEAR(split.refracted.y, 0.0, 1e-7) << degrees;
    EXPECT_LT(split.refracted.x, 0.0) << degrees;
  }
}

TEST(Glass, ReflectsOnePolarisationAtBrewstersAngle) {
  // At tan = n no light that swings in the plane is reflected; of the other ((n^2 - 1) / (n^2 +
  // 1))^2.
  const double n = 1.5;
  const double expected = 0.5 * std::pow((n * n - 1.0) / (n * n + 1.0), 2.0);
  EXPECT_NEAR(split_at(std::atan(n) * 180.0 / std::acos(-1.0), 1.5F).reflectance, expected, 1e-6);
}

TEST(Glass, ReflectsAllLightBeyondTheCriticalAngle) {
  // From within: the normal points along the ray. Critical at asin(1 / 1.5) = 41.8 degrees.
  const auto within = [](double degrees) {
    return shared::split_ray(-leaning(degrees), kDown, 1.5F);
  };
  EXPECT_NEAR(within(0.0).reflectance, 0.04F, 1e-6);
  EXPECT_LT(within(41.0).reflectance, 0.7F);
  EXPECT_NEAR(within(42.0).reflectance, 1.0F, 1e-6);
  EXPECT_NEAR(within(50.0).reflectance, 1.0F, 1e-6);
  // Away from the normal on the way out: sin 45 = 1.5 sin 28.1.
  EXPECT_NEAR(glm::dot(within(28.1255).refracted, -leaning(28.1255)), std::sqrt(0.5), 1e-5);
}

TEST(Glass, RefractsTheSameOnBothSides) {
  // A ray within meets an outward normal on the way out, however flat.
  for (const double degrees : {0.0, 20.0, 41.0, 60.0, 89.0}) {
    const shared::SplitRay split = shared::split_within(-leaning(degrees), kDown, 1.5F);
    const double sine = 1.5 * std::sin(degrees * std::acos(-1.0) / 180.0);
    if (sine < 1.0) {
      EXPECT_NEAR(glm::dot(split.refracted, -leaning(degrees)), std::sqrt(1.0 - sine * sine), 1e-5);
      EXPECT_NEAR(glm::length(split.refracted), 1.0, 1e-6);
      // What crosses a surface one way is reflected as much the other way.
      const double outside = std::asin(sine) * 180.0 / std::acos(-1.0);
      EXPECT_NEAR(split.reflectance, split_at(outside, 1.5F).reflectance, 1e-4) << degrees;
    } else {
      EXPECT_NEAR(split.reflectance, 1.0F, 1e-6) << degrees;
      EXPECT_NEAR(glm::length(split.reflected), 1.0, 1e-6);
    }
  }
  const shared::SplitRay leaned = shared::split_within(-leaning(95.0), kDown, 1.5F);
  expect_near(glm::normalize(leaned.refracted), kDown, "straight on");
  EXPECT_NEAR(leaned.reflectance, 0.0F, 1e-6);
}

TEST(Glass, OfIndexOneIsInvisible) {
  for (const double degrees : {0.0, 45.0, 89.999, 90.0, 100.0}) {
    const shared::SplitRay split = split_at(degrees, 1.0F);
    EXPECT_NEAR(split.reflectance, 0.0F, 1e-6) << degrees;
    expect_near(split.refracted, kDown, "straight on");
  }
}

TEST(Glass, LosesNoLightAndTakesColoursByBeersLaw) {
  CubeMap cube;
  cube.size = 1;
  for (auto& face : cube.faces) face = {glm::vec3(1.0F)};
  Lighting lighting{{}, 0, {{{Material::Glass, {1.5F, glm::vec3(0.0F), 0.0F}}, &cube}}};
  for (double degrees = 0.0; degrees < 180.0; degrees += 7.5)
    expect_near(shade_grey(lighting, leaning(degrees)), glm::vec3(1.0F), "white");
  lighting.materials[0].settings.constants.absorption = {1.0F, 2.0F, 0.0F};
  // Straight through a diameter; 0.04 is reflected before.
  expect_near(shade_grey(lighting, leaning(0.0)),
              glm::vec3(0.04F) + 0.96F * glm::vec3(std::exp(-1.0F), std::exp(-2.0F), 1.0F),
              "tinted");
}

}  // namespace
}  // namespace relief
