// The camera: where an orbit stands, what fits into the image, what depth is.
#include "common/scene/camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec4.hpp>

namespace relief {
namespace {

/// Double rounding of a handful of operations on numbers near 1.
constexpr double kRounding = 1e-14;

void expect_close(glm::dvec3 found, glm::dvec3 expected, double tolerance = kRounding) {
  EXPECT_LE(glm::length(found - expected), tolerance)
      << found.x << " " << found.y << " " << found.z << " instead of " << expected.x << " "
      << expected.y << " " << expected.z;
}

TEST(OrbitCamera, StandsWhereTheAnglesSay) {
  const glm::dvec3 centre(3.0, -2.0, 7.0);
  const auto direction = [&](double azimuth, double elevation) {
    const Camera camera = orbit_camera(centre, 0.5, {azimuth, elevation, 4.0}, 45.0, 1.25);
    EXPECT_EQ(camera.target, centre);
    EXPECT_EQ(camera.vertical_fov_degrees, 45.0);
    EXPECT_NEAR(glm::length(camera.eye - centre), 4.0 * 0.5, kRounding);
    return glm::normalize(camera.eye - centre);
  };
  expect_close(direction(0, 0), {0, 0, 1});
  expect_close(direction(90, 0), {1, 0, 0});
  expect_close(direction(180, 0), {0, 0, -1});
  expect_close(direction(-90, 0), {-1, 0, 0});
  expect_close(direction(0, 90), {0, 1, 0});
  expect_close(direction(30, -90), {0, -1, 0});
  expect_close(direction(90, 30), {std::sqrt(0.75), 0.5, 0});
}

TEST(OrbitCamera, LooksAtTheCentreWithYUp) {
  for (const double azimuth : {0.0, 37.0, 200.0}) {
    for (const double elevation : {-90.0, -89.0, 0.0, 60.0, 90.0}) {
      const Camera camera = orbit_camera({1, 2, 3}, 2.0, {azimuth, elevation, 0.0}, 45.0, 1.0);
      const glm::dmat3 view = view_rotation(camera);
      // The centre lies straight ahead, and what is above it is above it in the image.
      const glm::dvec3 ahead = view * (camera.target - camera.eye);
      expect_close(glm::normalize(ahead), {0, 0, -1});
      expect_close(view * camera.up, {0, 1, 0});
      EXPECT_NEAR(glm::determinant(view), 1.0, kRounding);
      // The world's +Y points up in the image, or straight along the view.
      EXPECT_NEAR((view * glm::dvec3(0, 1, 0)).y, std::cos(glm::radians(elevation)), kRounding);
    }
  }
}

TEST(ViewRotation, IsARotationEvenIfUpRunsAlongTheView) {
  for (const glm::dvec3 direction : {glm::dvec3(0, 1, 0), {0, -2, 0}, {0, 0, 3}, {1, 1, 1}}) {
    Camera camera;
    camera.eye = direction;
    camera.target = {0, 0, 0};
    camera.up = direction;
    const glm::dmat3 view = view_rotation(camera);
    const glm::dmat3 product = glm::transpose(view) * view;
    for (glm::length_t c = 0; c < 3; ++c) {
      for (glm::length_t r = 0; r < 3; ++r) {
        EXPECT_NEAR(product[c][r], c == r ? 1.0 : 0.0, kRounding);
      }
    }
    EXPECT_NEAR(glm::determinant(view), 1.0, kRounding);
    expect_close(view * glm::normalize(direction), {0, 0, 1});
  }
}

/// Clip coordinates of a world position, divided by w.
glm::dvec3 project(const Camera& camera, double aspect, glm::dvec3 world) {
  const glm::dvec3 eye = view_rotation(camera) * (world - camera.eye);
  const glm::dvec4 clip =
      glm::dmat4(reversed_infinite_projection(camera.vertical_fov_degrees, aspect, 0.01)) *
      glm::dvec4(eye, 1.0);
  return glm::dvec3(clip) / clip.w;
}

TEST(OrbitCamera, FitsTheSphereExactly) {
  const glm::dvec3 centre(5.0, 1.0, -2.0);
  const double radius = 3.0;
  for (const double aspect : {0.5, 1.0, 1.25, 2.0}) {
    const Camera camera = orbit_camera(centre, radius, {25.0, 40.0, 0.0}, 45.0, aspect);
    double largest_x = 0.0;
    double largest_y = 0.0;
    const int steps = 720;
    for (int a = 0; a < steps; ++a) {
      for (int b = 0; b <= steps / 2; ++b) {
        const double u = glm::radians(a * 360.0 / steps);
        const double v = glm::radians(b * 360.0 / steps - 90.0);
        const glm::dvec3 surface =
            centre +
            radius * glm::dvec3(std::cos(u) * std::cos(v), std::sin(v), std::sin(u) * std::cos(v));
        const glm::dvec3 ndc = project(camera, aspect, surface);
        largest_x = std::max(largest_x, std::abs(ndc.x));
        largest_y = std::max(largest_y, std::abs(ndc.y));
      }
    }
    // It touches the border of the smaller side. The points are half a degree apart, so that the
    // touching one is missed by 2e-5 at most; the projection's matrix is single precision.
    EXPECT_NEAR(aspect < 1.0 ? largest_x : largest_y, 1.0, 5e-5) << aspect;
    EXPECT_LE(largest_x, 1.0 + 1e-6) << aspect;
    EXPECT_LE(largest_y, 1.0 + 1e-6) << aspect;
  }
}

TEST(OrbitCamera, RefersToHowTheModelStands) {
  // Z up: in front is -Y, to the right +X, and from above north is up.
  const Camera front = orbit_camera({}, 1.0, {0.0, 0.0, 4.0}, 45.0, 1.0, kZUp);
  EXPECT_LT(glm::distance(front.eye, glm::dvec3(0.0, -4.0, 0.0)), kRounding);
  EXPECT_LT(glm::distance(front.up, glm::dvec3(0.0, 0.0, 1.0)), kRounding);
  const Camera right = orbit_camera({}, 1.0, {90.0, 0.0, 4.0}, 45.0, 1.0, kZUp);
  EXPECT_LT(glm::distance(right.eye, glm::dvec3(4.0, 0.0, 0.0)), kRounding);
  const Camera top = orbit_camera({}, 1.0, {0.0, 90.0, 4.0}, 45.0, 1.0, kZUp);
  EXPECT_LT(glm::distance(top.eye, glm::dvec3(0.0, 0.0, 4.0)), kRounding);
  EXPECT_LT(glm::distance(top.up, glm::dvec3(0.0, 1.0, 0.0)), kRounding);
}

TEST(Stance, OfAnUpDirectionHasItsFrontAtRightAngles) {
  EXPECT_EQ(stance_of({0.0, 2.0, 0.0}), Stance{});
  EXPECT_EQ(stance_of({0.0, 0.0, 1e-200}), kZUp);
  EXPECT_EQ(stance_of({0.0, -1.0, 0.0}).front, glm::dvec3(0.0, 0.0, -1.0));
  EXPECT_EQ(stance_of({0.0, 0.0, -1.0}).front, glm::dvec3(0.0, 1.0, 0.0));
  EXPECT_EQ(stance_of({-1.0, 0.0, 0.0}).front, glm::dvec3(0.0, 0.0, 1.0));
  for (const glm::dvec3 up : {glm::dvec3(1, 2, 3), glm::dvec3(-3, 2, 1), glm::dvec3(1, 1, 1)}) {
    const Stance stance = stance_of(1e300 * up);
    EXPECT_NEAR(glm::dot(stance.up, glm::normalize(up)), 1.0, kRounding);
    EXPECT_NEAR(glm::length(stance.front), 1.0, kRounding);
    EXPECT_NEAR(glm::dot(stance.up, stance.front), 0.0, kRounding);
  }
}

TEST(Camera, RollsCounterClockwiseAndZooms) {
  const Camera camera{{0.0, 0.0, 5.0}, {}, {0.0, 1.0, 0.0}, 90.0};
  // The camera's top turns to its left, -X.
  EXPECT_LT(glm::distance(rolled(camera, 90.0).up, glm::dvec3(-1.0, 0.0, 0.0)), kRounding);
  // Half the height at distance 1 is tan 45 degrees = 1, then a half.
  EXPECT_NEAR(zoomed(camera, 2.0).vertical_fov_degrees, 2.0 * glm::degrees(std::atan(0.5)),
              kRounding);
  Camera orthographic = camera;
  orthographic.orthographic_height = 3.0;
  EXPECT_EQ(zoomed(orthographic, 2.0).orthographic_height, 1.5);
}

TEST(Projection, OfAnOrthographicCameraIsLinear) {
  const glm::dmat4 m = reversed_orthographic_projection({4.0, 2.0, 10.0, 14.0});
  const auto clip = [&m](glm::dvec3 eye) { return m * glm::dvec4(eye, 1.0); };
  // From right to left, bottom to top, near to far; binary fractions, which are exact.
  EXPECT_EQ(clip({4.0, -2.0, -10.0}), glm::dvec4(1.0, -1.0, 1.0, 1.0));
  EXPECT_EQ(clip({-2.0, 1.0, -13.0}), glm::dvec4(-0.5, 0.5, 0.25, 1.0));
  EXPECT_EQ(clip({0.0, 0.0, -14.0}), glm::dvec4(0.0, 0.0, 0.0, 1.0));
}

TEST(Projection, ReversesDepthToInfinity) {
  const double near = 0.25;
  const glm::mat4 m = reversed_infinite_projection(90.0, 2.0, near);
  const auto depth = [&](float distance) {
    const glm::vec4 clip = m * glm::vec4(0.0F, 0.0F, -distance, 1.0F);
    EXPECT_EQ(clip.w, distance);
    return clip.z / clip.w;
  };
  EXPECT_EQ(depth(0.25F), 1.0F);
  EXPECT_EQ(depth(0.5F), 0.5F);
  EXPECT_EQ(depth(1024.0F), 0.25F / 1024.0F);
  EXPECT_GT(depth(1e30F), 0.0F);
  // 90 degrees high and twice as wide: the corner of the image at distance 1 is (2, 1).
  const glm::vec4 corner = m * glm::vec4(2.0F, 1.0F, -1.0F, 1.0F);
  EXPECT_NEAR(corner.x, 1.0F, 1e-6F);
  EXPECT_NEAR(corner.y, 1.0F, 1e-6F);
}

}  // namespace
}  // namespace relief
