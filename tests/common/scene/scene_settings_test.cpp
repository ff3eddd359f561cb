// Settings of a scene, of its views and of the command, laid over each other.
#include <gtest/gtest.h>

#include <vector>

#include "common/scene/scene.h"
#include "common/scene/views/view_camera.h"

namespace relief {
namespace {

TEST(SceneSettings, LaterSettingsOverrideAndOrbitsAndEyesReplaceEachOther) {
  SceneSettings base;
  base.orbit = Orbit{10, 20, 0};
  base.material = Material::Unlit;
  base.fov_degrees = 20.0;
  SceneSettings over;
  over.material = Material::Mirror;
  EXPECT_EQ(overlay(base, over).material, Material::Mirror);
  EXPECT_EQ(overlay(base, over).fov_degrees, 20.0);
  EXPECT_EQ(overlay(base, over).orbit->azimuth_degrees, 10.0);
  over.eye = glm::dvec3(1.0);
  EXPECT_FALSE(overlay(base, over).orbit);
  EXPECT_FALSE(overlay(over, base).eye);
}

TEST(SceneSettings, OptionsAreOverlaidByKey) {
  SceneSettings base;
  base.options = {{"shape", "round"}, {"passes", 2.0}};
  SceneSettings over;
  over.options = {{"passes", 3.0}, {"dot-size", 1.0}};
  EXPECT_EQ(overlay(base, over).options,
            (OptionValues{{"shape", "round"}, {"passes", 3.0}, {"dot-size", 1.0}}));
}

TEST(SceneSettings, FieldsOfViewAndOrthographicImagesReplaceEachOther) {
  SceneSettings perspective;
  perspective.fov_degrees = 20.0;
  SceneSettings orthographic;
  orthographic.orthographic = OrthographicSize{3.0};
  EXPECT_FALSE(overlay(perspective, orthographic).fov_degrees);
  EXPECT_EQ(overlay(perspective, orthographic).orthographic->height, 3.0);
  EXPECT_FALSE(overlay(orthographic, perspective).orthographic);
  EXPECT_EQ(overlay(orthographic, {}).orthographic->height, 3.0);
}

TEST(SceneSettings, EveryMemberIsOverlaid) {
  SceneSettings over;
  over.size = ImageSize{2, 3};
  over.eye = glm::dvec3(1);
  over.target = glm::dvec3(2);
  over.up = glm::dvec3(3);
  over.fov_degrees = 4.0;
  over.engine = "onepass";
  over.options = {{"samples", 2.0}};
  over.material = Material::Lit;
  over.ior = 2.0;
  over.absorption = glm::vec3(1);
  over.roughness = 0.5;
  over.exposure = 1.0;
  over.lights = std::vector<Light>(1);
  over.ambient = glm::vec3(1);
  over.environment = "sky.hdr";
  over.environment_rotation_degrees = 30.0;
  over.background = Background{};
  over.outputs = Outputs{};
  const SceneSettings both = overlay({}, over);
  EXPECT_TRUE(both.size && both.eye && both.target && both.up && both.fov_degrees && both.engine &&
              !both.options.empty() && both.material && both.lights && both.ambient && both.ior &&
              both.absorption && both.roughness && both.exposure && both.environment &&
              both.environment_rotation_degrees && both.background && both.outputs);
}

TEST(SceneSettings, TheCameraIsOnAnOrbitOrAtTheEye) {
  PatchModel model;
  model.bounds = {{0, 0, 0}, {2, 4, 6}};
  model.bounding_radius = 3.0;
  SceneSettings settings;
  settings.orbit = Orbit{90.0, 0.0, 2.0};
  settings.fov_degrees = 30.0;
  auto camera = camera_for(settings, model);
  ASSERT_TRUE(camera);
  // Azimuth 90 is +X, two radii of 3 from the middle.
  EXPECT_LT(glm::distance(camera->eye, glm::dvec3(7, 2, 3)), 1e-12);
  EXPECT_EQ(camera->vertical_fov_degrees, 30.0);

  settings = {};
  settings.eye = glm::dvec3(0, 0, 9);
  camera = camera_for(settings, model);
  ASSERT_TRUE(camera);
  EXPECT_EQ(camera->target, glm::dvec3(1, 2, 3));
  EXPECT_EQ(camera->up, glm::dvec3(0, 1, 0));
  settings.eye = glm::dvec3(1, 2, 3);
  EXPECT_FALSE(camera_for(settings, model)) << "looks from the middle at the middle";
  settings.target = glm::dvec3(0, 0, 9);
  EXPECT_TRUE(camera_for(settings, model));

  settings.orthographic = OrthographicSize{2.5};
  EXPECT_EQ(camera_for(settings, model)->orthographic_height, 2.5);
  EXPECT_FALSE(camera_for({}, model)->is_orthographic());
  // By default the box, which ends 4 above the line of sight and 2 beside it, takes nine tenths of
  // the image.
  settings.orthographic = OrthographicSize{};
  settings.eye = glm::dvec3(0.0, 0.0, 20.0);
  settings.target = glm::dvec3(0.0);
  settings.size = ImageSize{200, 100};
  EXPECT_NEAR(camera_for(settings, model)->orthographic_height, 8.0 / 0.9, 1e-12);

  camera = camera_for({}, PatchModel{});
  ASSERT_TRUE(camera);
  EXPECT_NE(camera->eye, camera->target) << "a model of no size";
}

}  // namespace
}  // namespace relief
