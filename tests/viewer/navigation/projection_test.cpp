#include "viewer/navigation/projection.h"

#include <gtest/gtest.h>

#include "ball.h"
#include "renderer/view/view.h"

namespace relief {
namespace {

Camera tilted(glm::dvec3 offset, double orthographic_height) {
  return {offset + glm::dvec3(30, -200, 90),
          offset + glm::dvec3(1, 2, 3),
          {0.2, 0.1, 1.0},
          37.0,
          orthographic_height};
}

TEST(Projection, IsTheInverseOfTheRay) {
  for (const double height : {0.0, 150.0}) {
    const Camera camera = tilted(kUtm, height);
    for (const glm::dvec2 cursor :
         {glm::dvec2(0, 0), glm::dvec2(1279, 3), glm::dvec2(700.25, 650)}) {
      const Ray ray = ray_through(camera, cursor, kSize);
      const auto seen = project(camera, ray.origin + 180.0 * ray.direction, kSize);
      ASSERT_TRUE(seen);
      EXPECT_LT(glm::distance(*seen, cursor), kSamePixel);
      const glm::dvec3 at = world_at(camera, cursor, 77.0, kSize);
      EXPECT_LT(glm::distance(*project(camera, at, kSize), cursor), kSamePixel);
      EXPECT_NEAR(depth_of(camera, at), 77.0, 1e-8);  // the rounding of positions is 1e-9
    }
  }
}

TEST(Projection, HasTheUpperLeftCornerWhereWindowsHaveIt) {
  const Camera camera{{0, 0, 10}, {0, 0, 0}, {0, 1, 0}, 90.0};
  const auto seen = project(camera, {-10.0 * 1280 / 800, 10, 0}, kSize);
  ASSERT_TRUE(seen);
  EXPECT_NEAR(seen->x, 0.0, 1e-9);
  EXPECT_NEAR(seen->y, 0.0, 1e-9);
}

TEST(Projection, DoesNotSeeWhatIsBehind) {
  EXPECT_FALSE(project(tilted({}, 0.0), {60, -500, 200}, kSize));
  EXPECT_FALSE(project(tilted({}, 100.0), {60, -500, 200}, kSize));
  EXPECT_FALSE(project(tilted({}, 0.0), tilted({}, 0.0).eye, kSize));
}

TEST(Projection, IsThatOfTheRenderer) {
  for (const double height : {0.0, 150.0}) {
    const Camera camera = tilted({}, height);
    const View view = make_view(camera, kImage.width, kImage.height, 0.1);
    const glm::dvec2 cursor(333.5, 120.5);
    const glm::dvec2 window(cursor.x, kSize.y - cursor.y);
    const Ray ray = ray_through(camera, cursor, kSize);
    EXPECT_LT(glm::distance(ray.origin, camera.eye + ray_start(view, window)), 1e-12);
    EXPECT_LT(glm::distance(ray.direction, glm::normalize(ray_through(view, window))), 1e-12);
  }
}

}  // namespace
}  // namespace relief
