#include "renderer/volume/splats/ray_space.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace relief {
namespace {

RayCamera camera_of(double orthographic_height) {
  Camera camera;
  camera.eye = {3.0, 2.0, 9.0};
  camera.target = {0.5, -0.25, 0.0};
  camera.orthographic_height = orthographic_height;
  return ray_camera(make_view(camera, 640, 480, 1e-3));
}

// Central differences of phi over 1e-5 of the distance are off by 1e-10 of the derivative, and by
// rounding, 1e-16 of 500 pixels over 1e-4, by 1e-9.
void expect_finite_differences(const RayCamera& camera, glm::dvec3 t) {
  const glm::dmat3 jacobian = ray_space_jacobian(camera, t);
  const double step = 1e-5 * t.z;
  for (glm::length_t axis = 0; axis < 3; ++axis) {
    glm::dvec3 by(0.0);
    by[axis] = step;
    const glm::dvec3 change =
        (to_ray_space(camera, t + by) - to_ray_space(camera, t - by)) / (2.0 * step);
    for (glm::length_t row = 0; row < 3; ++row)
      EXPECT_NEAR(jacobian[axis][row], change[row], 1e-7 * (1.0 + std::abs(change[row])));
  }
}

TEST(RaySpace, JacobianIsThatOfFiniteDifferences) {
  const RayCamera perspective = camera_of(0.0);
  const RayCamera orthographic = camera_of(4.0);
  for (const glm::dvec3 t : {glm::dvec3(0, 0, 5), glm::dvec3(1, -2, 7), glm::dvec3(-4, 3, 2),
                             glm::dvec3(0.1, 20, 0.5)}) {
    expect_finite_differences(perspective, t);
    expect_finite_differences(orthographic, t);
  }
}

// |J| = |t| / z^3 times the pixels for a unit: the restored formulas of [Zwicker 2002].
TEST(RaySpace, DeterminantIsTheDistanceOverTheCubedDepth) {
  const RayCamera camera = camera_of(0.0);
  const glm::dvec3 t(1.5, -0.5, 4.0);
  EXPECT_NEAR(std::abs(glm::determinant(ray_space_jacobian(camera, t))),
              camera.scale.x * camera.scale.y * glm::length(t) / (4.0 * 4.0 * 4.0), 1e-9);
}

TEST(RaySpace, PlacesAreThoseOfThePixelsRays) {
  Camera camera;
  camera.eye = {3.0, 2.0, 9.0};
  const View view = make_view(camera, 640, 480, 1e-3);
  const RayCamera rays = ray_camera(view);
  const glm::dvec2 pixel(100.5, 321.5);
  const glm::dvec3 point = view.eye + ray_start(view, pixel) + 7.0 * ray_through(view, pixel);
  const glm::dvec3 place = to_ray_space(rays, to_camera(rays, point));
  EXPECT_NEAR(place.x, pixel.x, 1e-9);
  EXPECT_NEAR(place.y, pixel.y, 1e-9);
}

}  // namespace
}  // namespace relief
