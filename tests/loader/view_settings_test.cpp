#include "loader/scene/view_settings.h"

#include <gtest/gtest.h>

namespace relief {
namespace {

PatchModel terrain() {
  PatchModel extent;
  extent.bounds = {{0, 0, 0}, {100, 80, 9}};
  extent.bounding_radius = 65.0;
  extent.stance = kZUp;
  return extent;
}

ScenePlan plan_of(std::size_t models) {
  ScenePlan plan;
  plan.models.resize(models);
  plan.views.resize(1);
  return plan;
}

Lights lights_of(const ScenePlan& plan) {
  const auto settings = render_settings_of(plan, plan.views.front(), terrain());
  EXPECT_TRUE(settings) << (settings ? "" : settings.error().message);
  return settings ? settings->lights : Lights();
}

TEST(LightsOfAView, AreTheSunOverTerrainUnlessThePlanSaysOthers) {
  ScenePlan plan = plan_of(1);
  EXPECT_EQ(lights_of(plan).list.size(), 3U);
  plan.views.front().settings.ambient = glm::vec3(0.5F);
  EXPECT_EQ(lights_of(plan).list.size(), 3U);
  EXPECT_EQ(lights_of(plan).ambient, glm::vec3(0.5F));
  plan.views.front().settings.lights = std::vector<Light>(1);
  EXPECT_EQ(lights_of(plan).list.size(), 1U);
}

TEST(LightsOfAView, AreFixedToTheCameraForScenesAndGrids) {
  EXPECT_TRUE(lights_of(plan_of(2)).list.empty());
  ScenePlan plan = plan_of(1);
  plan.views.front().settings.engine = "volume";
  EXPECT_TRUE(lights_of(plan).list.empty());
}

TEST(LightsOfAView, AreTheEnvironmentIfThereIsOne) {
  ScenePlan plan = plan_of(1);
  plan.views.front().settings.environment = "sky.hdr";
  const Lights lights = lights_of(plan);
  EXPECT_TRUE(lights.from_environment);
  EXPECT_TRUE(lights.list.empty());
}

/// How an environment stands about a terrain, whose Z is up.
Stance standing(const SceneSettings& settings) {
  ScenePlan plan = plan_of(1);
  plan.views.front().settings = settings;
  const auto made = render_settings_of(plan, plan.views.front(), terrain());
  EXPECT_TRUE(made);
  return made ? made->environment_stance : Stance();
}

TEST(EnvironmentOfAView, StandsAsTheModelDoes) {
  SceneSettings settings;
  EXPECT_EQ(standing(settings), kZUp);
  settings.up = glm::dvec3(0.0, 1.0, 0.0);
  EXPECT_EQ(standing(settings), Stance{});
  // The up direction of an eye says how the camera is held.
  settings.eye = glm::dvec3(3.0);
  EXPECT_EQ(standing(settings), kZUp);
}

}  // namespace
}  // namespace relief
