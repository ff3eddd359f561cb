#include "common/scene/views/view_camera.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "common/extremes.h"

namespace relief {
namespace {

/// A model that fills its box.
PatchModel box_model(glm::dvec3 size, const Stance& stance = {}) {
  PatchModel model;
  model.bounds = {-0.5 * size, 0.5 * size};
  model.bounding_radius = 0.5 * glm::length(size);
  model.extremes = corners_of(model.bounds);
  model.stance = stance;
  return model;
}

double elevation_of(const Camera& camera, const Stance& stance) {
  return std::asin(glm::dot(glm::normalize(camera.eye - camera.target), stance.up));
}

TEST(CameraFor, LooksAtABodyFromTheFrontAndAtTerrainFromAbove) {
  const Camera body = *camera_for({}, box_model({1, 2, 1}));
  const Camera terrain = *camera_for({}, box_model({100, 100, 5}, kZUp));
  EXPECT_LT(elevation_of(body, {}), 0.35);
  EXPECT_GT(elevation_of(terrain, kZUp), 0.5);
  EXPECT_GT(glm::dot(body.eye, Stance{}.front), 0.0);
  EXPECT_GT(glm::dot(terrain.eye, kZUp.front), 0.0);
}

TEST(CameraFor, LooksAtASensorsFrameFromTheSensor) {
  Stance sensor{{0, -1, 0}, {0, 0, -1}, true};
  const Camera camera = *camera_for({}, box_model({4, 3, 1}, sensor));
  EXPECT_NEAR(glm::dot(glm::normalize(camera.eye - camera.target), sensor.front), 1.0, 1e-12);
  EXPECT_NEAR(glm::dot(camera.up, sensor.up), 1.0, 1e-12);
}

TEST(CameraFor, TakesTheUpDirectionThatIsAskedFor) {
  SceneSettings settings;
  settings.orbit = Orbit{0.0, 0.0, 2.0};
  settings.up = glm::dvec3(0, 0, 3);
  const Camera camera = *camera_for(settings, box_model({1, 1, 1}));
  EXPECT_NEAR(glm::dot(camera.up, {0, 0, 1}), 1.0, 1e-12);
  EXPECT_LT(camera.eye.y, -0.5);
}

TEST(FilmFrames, GoOnceAroundAtOneDistance) {
  SceneSettings settings;
  settings.orbit = Orbit{10.0, 20.0, 0.0};
  const PatchModel model = box_model({1, 3, 6});
  const auto frames = film_frames(settings, model, 8);
  ASSERT_EQ(frames.size(), 8U);
  double smallest = 1e300;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    EXPECT_EQ(frames[i].orbit->azimuth_degrees, 10.0 + 45.0 * static_cast<double>(i));
    EXPECT_EQ(frames[i].orbit->distance_in_radii, frames[0].orbit->distance_in_radii);
    const Camera camera = *camera_for(frames[i], model);
    EXPECT_LT(glm::length(camera.target), 1e-12);
    // No frame needs a greater distance; one needs all of it.
    SceneSettings alone = settings;
    alone.orbit->azimuth_degrees = frames[i].orbit->azimuth_degrees;
    const Camera framed = *camera_for(alone, model);
    smallest = std::min(smallest, glm::length(camera.eye) - glm::length(framed.eye));
  }
  EXPECT_GE(smallest, -1e-9);
}

TEST(FilmFrames, OfAnOrthographicCameraHaveOneHeight) {
  SceneSettings settings;
  settings.orthographic = OrthographicSize{};
  const auto frames = film_frames(settings, box_model({1, 3, 6}), 12);
  for (const SceneSettings& frame : frames)
    EXPECT_EQ(frame.orthographic->height, frames[0].orthographic->height);
}

}  // namespace
}  // namespace relief
