#include "common/scene/views/first_lights.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace relief {
namespace {

PatchModel model_of(glm::dvec3 size, const Stance& stance) {
  PatchModel model;
  model.bounds = {-0.5 * size, 0.5 * size};
  model.stance = stance;
  return model;
}

TEST(FirstLights, OfTerrainAreASunInTheWestNorthWest) {
  const Lights lights = first_lights({}, model_of({100, 80, 9}, kZUp));
  ASSERT_EQ(lights.list.size(), 3U);
  for (const Light& light : lights.list) {
    EXPECT_EQ(light.kind, LightKind::Directional);
    EXPECT_NEAR(glm::length(light.position), 1.0, 1e-12);
  }
  const glm::dvec3 sun = lights.list.front().position;
  EXPECT_LT(sun.x, -0.5);
  EXPECT_GT(sun.y, 0.3);
  EXPECT_GT(sun.z, 0.5);
}

TEST(FirstLights, FollowTheUpDirection) {
  SceneSettings settings;
  settings.up = glm::dvec3(0, 1, 0);
  const Lights lights = first_lights(settings, model_of({100, 9, 80}, kZUp));
  ASSERT_EQ(lights.list.size(), 3U);
  EXPECT_GT(lights.list.front().position.y, 0.5);
  // With Y up north is -Z.
  EXPECT_LT(lights.list.front().position.z, -0.3);
  EXPECT_TRUE(first_lights(settings, model_of({100, 80, 9}, kZUp)).list.empty());
}

TEST(FirstLights, OfAllElseAreFixedToTheCamera) {
  EXPECT_TRUE(first_lights({}, model_of({2, 1, 1}, kZUp)).list.empty());
  PatchModel plate = model_of({100, 80, 9}, kZUp);
  plate.is_closed = true;
  EXPECT_TRUE(first_lights({}, plate).list.empty());
  const Stance sensor{{0, 0, 1}, {0, -1, 0}, true};
  EXPECT_TRUE(first_lights({}, model_of({100, 80, 9}, sensor)).list.empty());
}

}  // namespace
}  // namespace relief
