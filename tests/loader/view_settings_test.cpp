#include "loader/view_settings.h"

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

}  // namespace
}  // namespace relief
