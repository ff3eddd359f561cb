#include "common/scene/views/framing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/trigonometric.hpp>
#include <random>
#include <vector>

namespace relief {
namespace {

// Positions of 2000 are rounded to 2e-13, which is 2e-7 of the smallest body.
constexpr double kFrameRounding = 2e-7;

/// A body with nothing alike on opposite sides.
std::vector<glm::dvec3> lopsided(glm::dvec3 centre, double size) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  std::vector<glm::dvec3> points;
  for (int i = 0; i < 200; ++i) {
    const glm::dvec3 p(any(random), any(random), any(random));
    points.push_back(centre + size * glm::dvec3(3.0 * p.x + p.y * p.y, p.y, 0.5 * p.z + p.x * p.x));
  }
  return points;
}

struct ImageBox {
  glm::dvec2 min{1e300};
  glm::dvec2 max{-1e300};
};

/// Where the points are seen, in halves of the image's width and height.
ImageBox seen_by(const Camera& camera, const std::vector<glm::dvec3>& points, double aspect) {
  const glm::dmat3 rotation = view_rotation(camera);
  const double slope = std::tan(glm::radians(camera.vertical_fov_degrees) / 2.0);
  ImageBox box;
  for (const glm::dvec3& p : points) {
    const glm::dvec3 eye = rotation * (p - camera.eye);
    EXPECT_LT(eye.z, 0.0) << "before the eye";
    const double half =
        camera.is_orthographic() ? camera.orthographic_height / 2.0 : -eye.z * slope;
    const glm::dvec2 at(eye.x / (half * aspect), eye.y / half);
    box = {glm::min(box.min, at), glm::max(box.max, at)};
  }
  return box;
}

TEST(Framed, ShowsPointsInTheMiddleAndAsLargeAsTheyFit) {
  for (const double size : {1e-6, 1.0, 1e6}) {
    const auto points = lopsided({1e3, -2e3, 5.0}, size);
    for (const double aspect : {0.3, 1.25, 4.0}) {
      for (const double height : {0.0, 1.0}) {
        Camera camera = orbit_camera({1e3, -2e3, 5.0}, 2.0 * size, {33.0, 21.0}, 60.0, aspect);
        camera.orthographic_height = height;
        const ImageBox box =
            seen_by(framed(rolled(camera, 17.0), points, aspect, true), points, aspect);
        EXPECT_NEAR(box.min.x, -box.max.x, kFrameRounding)
            << size << ' ' << aspect << ' ' << height;
        EXPECT_NEAR(box.min.y, -box.max.y, kFrameRounding);
        EXPECT_NEAR(std::max(box.max.x, box.max.y), kFramedShare, kFrameRounding);
      }
    }
  }
}

TEST(Framed, KeepsDirectionAndGivenHeight) {
  const auto points = lopsided({}, 1.0);
  Camera camera = orbit_camera({}, 2.0, {-70.0, -40.0}, 30.0, 1.0);
  camera.orthographic_height = 5.0;
  const Camera result = framed(camera, points, 1.0, false);
  EXPECT_EQ(result.orthographic_height, 5.0);
  EXPECT_NEAR(glm::dot(glm::normalize(result.eye - result.target), glm::normalize(camera.eye)), 1.0,
              kFrameRounding);
}

TEST(Framed, PointsWithoutSizeAreSeen) {
  const std::vector<glm::dvec3> one{{4.0, 5.0, 6.0}};
  Camera camera = orbit_camera(one.front(), 1.0, {}, 45.0, 1.25);
  const Camera perspective = framed(camera, one, 1.25, true);
  EXPECT_GT(glm::distance(perspective.eye, one.front()), 0.0);
  camera.orthographic_height = 1.0;
  EXPECT_GT(framed(camera, one, 1.25, true).orthographic_height, 0.0);
}

TEST(FramingDistance, ShowsThePointsFromTheTargetsAxis) {
  const auto points = lopsided({}, 1.0);
  Camera camera = orbit_camera({}, 2.0, {10.0, 30.0}, 45.0, 1.25);
  const double distance = framing_distance(camera, points, 1.25);
  camera.eye *= distance / glm::length(camera.eye);
  const ImageBox box = seen_by(camera, points, 1.25);
  const double farthest = std::max({-box.min.x, box.max.x, -box.min.y, box.max.y});
  EXPECT_NEAR(farthest, kFramedShare, kFrameRounding);
}

}  // namespace
}  // namespace relief
