// Shading against values computed by hand.
#include "renderer/shading.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

namespace relief {
namespace {

/// One light from +Z and a little from everywhere.
shared::Frame one_light() {
  shared::Frame frame{};
  frame.light_direction[0] = {0.0F, 0.0F, 1.0F, 0.0F};
  frame.light_colour[0] = {1.0F, 0.5F, 0.25F, 0.0F};
  frame.light_direction[1] = frame.light_direction[2] = {1.0F, 0.0F, 0.0F, 0.0F};
  frame.light_ambient = {0.1F, 0.1F, 0.1F, 0.0F};
  return frame;
}

const glm::vec3 kDown(0.0F, 0.0F, -1.0F);

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
  EXPECT_EQ(shade(Material::Unlit, albedo, kDown, kDown, one_light(), nullptr), albedo);
}

TEST(Shading, LitFacingTheLight) {
  // Diffuse 0.5 (0.1 + light), and the highlight's middle: 0.25 light.
  expect_near(shade(Material::Lit, glm::vec3(0.5F), leaning(0.0), kDown, one_light(), nullptr),
              {0.8F, 0.425F, 0.2375F}, "facing");
}

TEST(Shading, LitAtSixtyDegreesHasNoHighlight) {
  // cos 60 = 0.5; the reflection points away from the light.
  expect_near(shade(Material::Lit, glm::vec3(0.5F), leaning(60.0), kDown, one_light(), nullptr),
              {0.3F, 0.175F, 0.1125F}, "60 degrees");
}

TEST(Shading, HighlightFallsOffWithTheFortiethPower) {
  // The normal leans by 5 degrees, the reflection by 10.
  const double diffuse = 0.5 * (0.1 + std::cos(std::acos(-1.0) / 36.0));
  const double highlight = 0.25 * std::pow(std::cos(std::acos(-1.0) / 18.0), 40.0);
  const glm::vec3 seen =
      shade(Material::Lit, glm::vec3(0.5F), leaning(5.0), kDown, one_light(), nullptr);
  EXPECT_NEAR(seen.x, diffuse + highlight, 2e-6);  // 40 times a float's rounding
}

TEST(Shading, BackSidesAreLitAsFronts) {
  for (const double lean : {0.0, 40.0}) {
    expect_near(shade(Material::Lit, glm::vec3(0.5F), -leaning(lean), kDown, one_light(), nullptr),
                shade(Material::Lit, glm::vec3(0.5F), leaning(lean), kDown, one_light(), nullptr),
                "back");
  }
}

TEST(Shading, NormalsThatLeanALittleAwayAreBentToGrazing) {
  // 100 degrees from the eye: bent to 90, where a grazing ray goes straight on; only ambient light
  // is left.
  expect_near(shade(Material::Lit, glm::vec3(0.5F), leaning(100.0), kDown, one_light(), nullptr),
              glm::vec3(0.05F), "bent");
}

TEST(Shading, MirrorReflectsTheEnvironment) {
  CubeMap cube;
  cube.size = 1;
  for (std::size_t face = 0; face < 6; ++face)
    cube.faces[face] = {glm::vec3(static_cast<float>(face))};
  // At 45 degrees what comes straight down goes to +X, from a level mirror it goes back to +Z.
  const auto face_seen = [&cube](double degrees) {
    return shade(Material::Mirror, glm::vec3(0.5F), leaning(degrees), kDown, one_light(), &cube).x;
  };
  EXPECT_NEAR(face_seen(45.0), 0.0, 1e-5);
  EXPECT_NEAR(face_seen(0.0), 4.0, 1e-5);
}

}  // namespace
}  // namespace relief
