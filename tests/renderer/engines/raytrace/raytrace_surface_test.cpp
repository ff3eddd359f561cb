// What rays meet, against surfaces that are known.
#include <gtest/gtest.h>

#include <random>

#include "tests/renderer/meshes.h"

namespace relief {
namespace {

using test::must_trace;
using test::pixel_ray;
using test::values;

/// A float's rounding, relative.
constexpr double kRayRounding = 6e-8;

/// The largest errors over a plane that fills the image.
struct PlaneErrors {
  double depth = 0.0;  ///< relative
  double uv = 0.0;     ///< world units, over the size of the sheet
  double normal_degrees = 0.0;
  std::uint64_t covered = 0;
};

/// A tilted sheet of 4 x 4 about `centre`, whose UV is the position on it, seen from a distance
/// along a slanted line.
PlaneErrors plane_errors(glm::dvec3 centre, double distance, double fov_degrees) {
  const glm::dvec3 u = 4.0 * glm::normalize(glm::dvec3(1.0, 0.2, 0.3));
  const glm::dvec3 v = 4.0 * glm::normalize(glm::cross(glm::dvec3(0.1, 0.2, 1.0), u));
  const glm::dvec3 normal = glm::normalize(glm::cross(u, v));
  TriangleMesh mesh;
  test::add_sheet(mesh, centre - 0.5 * (u + v), u, v);
  mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  mesh.patches = {7, 7, 7, 7};
  const glm::dvec3 outward = glm::normalize(normal + 0.1 * u);
  const RenderSettings settings =
      test::traced_image({centre + distance * outward,
                          centre + 0.01 * std::min(distance, 3.0) * glm::dvec3(1, 2, 3),
                          {0, 1, 0},
                          fov_degrees});
  const RenderResult result = must_trace(mesh, settings);
  PlaneErrors errors;
  errors.covered = result.covered_pixels;
  for (std::size_t k = 0; k < values(result.image, "Z").size(); ++k) {
    const glm::dvec3 ray = pixel_ray(settings, k % settings.width, k / settings.width);
    const double depth =
        glm::dot(mesh.positions[0] - settings.camera.eye, normal) / glm::dot(ray, normal);
    const glm::dvec3 from_corner = settings.camera.eye + depth * ray - mesh.positions[0];
    const glm::dvec2 uv(glm::dot(from_corner, u) / 16.0, glm::dot(from_corner, v) / 16.0);
    const glm::dvec2 seen(values(result.image, "UV.U")[k], values(result.image, "UV.V")[k]);
    errors.depth = std::max(errors.depth, std::abs(values(result.image, "Z")[k] / depth - 1.0));
    errors.uv = std::max(errors.uv, glm::length(seen - uv));
    errors.normal_degrees = std::max(
        errors.normal_degrees, test::degrees_between(test::normal_of(result.image, k), normal));
    EXPECT_EQ(values(result.image, "patch")[k], 7.0F);
  }
  return errors;
}

TEST(RayTracedPlane, IsExactFromNearAndFar) {
  struct Look {
    double distance;
    double fov_degrees;
  };
  for (const Look look : {Look{3.0, 40.0}, Look{0.01, 40.0}, Look{3000.0, 0.05}}) {
    const PlaneErrors errors = plane_errors({0.3, -0.2, 0.1}, look.distance, look.fov_degrees);
    EXPECT_EQ(errors.covered, 96U * 80U) << look.distance;
    // The outputs are floats of exact values.
    EXPECT_LT(errors.depth, kRayRounding) << look.distance;
    EXPECT_LT(errors.uv, kRayRounding) << look.distance;
    EXPECT_LT(errors.normal_degrees, 2.0 * kRayRounding * 180.0 / std::acos(-1.0)) << look.distance;
  }
}

TEST(RayTracedPlane, IsExactAtGeoreferencedCoordinates) {
  const PlaneErrors errors = plane_errors({5.0e5, 4.2e6, 1.0e7}, 3.0, 40.0);
  EXPECT_EQ(errors.covered, 96U * 80U);
  // Doubles at 1e7 are 1.9e-9 apart; that is what the mesh itself is rounded to.
  EXPECT_LT(errors.depth, kRayRounding + 4e-9);
  EXPECT_LT(errors.uv, kRayRounding + 4e-9);
}

TEST(RayTracedSphere, HasItsSilhouetteDepthAndNormals) {
  constexpr std::uint32_t kRings = 128;
  const glm::dvec3 centre(3.0, -2.0, 1.0);
  const TriangleMesh mesh = test::sphere_mesh(kRings, centre);
  const RenderSettings settings =
      test::traced_image(orbit_camera(centre, 1.0, {30.0, 20.0}, 45.0, 1.2));
  const RenderResult result = must_trace(mesh, settings);
  // The largest triangles are halves of squares with this side, so that no position of one is
  // farther from its corners than half the diagonal; so deep below the sphere it lies.
  const double side = std::acos(-1.0) / kRings;
  const double sagitta = 1.0 - std::sqrt(1.0 - side * side / 2.0);
  std::size_t hit = 0;
  for (std::size_t k = 0; k < values(result.image, "Z").size(); ++k) {
    const glm::dvec3 ray = pixel_ray(settings, k % settings.width, k / settings.width);
    const glm::dvec3 eye = settings.camera.eye - centre;
    const double passes = glm::length(glm::cross(eye, glm::normalize(ray)));
    const bool covered = values(result.image, "A")[k] > 0.0F;
    if (passes > 1.0) {
      EXPECT_FALSE(covered) << passes;
    } else if (passes < 1.0 - sagitta) {
      EXPECT_TRUE(covered) << passes;
    }
    const double cosine = std::sqrt(std::max(1.0 - passes * passes, 0.0));
    if (cosine < 0.3) continue;
    ++hit;
    const double a = glm::dot(ray, ray);
    const double b = glm::dot(ray, eye);
    const double depth = (-b - std::sqrt(b * b - a * (glm::dot(eye, eye) - 1.0))) / a;
    const double behind = values(result.image, "Z")[k] - depth;
    // Up to the sagitta below the sphere, seen at an angle; rays are a little longer than depths.
    EXPECT_GT(behind, -2.0 * kRayRounding * depth);
    EXPECT_LT(behind, 1.1 * sagitta / cosine);
    // The ray goes on below the sphere, along which the normal turns by `sagitta / tan`; linear
    // interpolation of unit vectors adds less than a quarter of that.
    const glm::dvec3 normal = eye + depth * ray;
    const double turned = 1.25 * sagitta / cosine * 180.0 / std::acos(-1.0);
    EXPECT_LT(test::degrees_between(test::normal_of(result.image, k), normal), turned);
  }
  EXPECT_GT(hit, 2500U);
}

TEST(RayTracedSphere, KeepsItsSilhouetteSeenFromAMillionRadii) {
  const TriangleMesh mesh = test::sphere_mesh(128);
  const RenderSettings settings =
      test::traced_image(orbit_camera({}, 1.0, {30.0, 20.0, 1e6}, 1.2e-4, 1.2));
  const RenderResult result = must_trace(mesh, settings);
  // As above. A direction's rounding, 1e-16 times the distance, is far below the sagitta.
  const double sagitta = 1.0 - std::sqrt(1.0 - std::pow(std::acos(-1.0) / 128, 2.0) / 2.0);
  std::size_t wrong = 0;
  for (std::size_t k = 0; k < values(result.image, "A").size(); ++k) {
    const glm::dvec3 ray = pixel_ray(settings, k % settings.width, k / settings.width);
    const double passes = glm::length(glm::cross(settings.camera.eye, glm::normalize(ray)));
    const bool covered = values(result.image, "A")[k] > 0.0F;
    wrong += (covered && passes > 1.0) || (!covered && passes < 1.0 - sagitta) ? 1 : 0;
  }
  EXPECT_EQ(wrong, 0U);
  EXPECT_GT(result.covered_pixels, 2000U);
}

TEST(RayTracedMesh, LetsNoRayThroughItsVertices) {
  // Every ray aims at a vertex; those are at random distances, so that triangles are steep.
  constexpr std::uint32_t kSide = 64;
  const RenderSettings settings =
      test::traced_image({{1.7, 2.3, 3.1}, {0.4, 0.2, 0.1}, {0, 1, 0}, 50.0}, kSide, kSide);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> distance(1.0, 1.3);
  TriangleMesh mesh;
  for (std::uint32_t y = 0; y < kSide; ++y) {
    for (std::uint32_t x = 0; x < kSide; ++x) {
      mesh.positions.push_back(settings.camera.eye + distance(random) * pixel_ray(settings, x, y));
      mesh.normals.emplace_back(0, 0, 1);
    }
  }
  for (std::uint32_t y = 0; y + 1 < kSide; ++y) {
    for (std::uint32_t x = 0; x + 1 < kSide; ++x) {
      const std::uint32_t a = y * kSide + x;
      mesh.triangles.push_back({a, a + 1, a + kSide + 1});
      mesh.triangles.push_back({a, a + kSide + 1, a + kSide});
    }
  }
  const RenderResult result = must_trace(mesh, settings);
  for (std::uint32_t y = 1; y + 1 < kSide; ++y) {
    for (std::uint32_t x = 1; x + 1 < kSide; ++x)
      EXPECT_EQ(values(result.image, "A")[std::size_t{y} * kSide + x], 1.0F) << x << " " << y;
  }
}

TEST(RayTracedSphere, GeoreferencedCoordinatesGiveTheSameImage) {
  const TriangleMesh near = test::sphere_mesh(40);
  RenderSettings settings = test::traced_image(orbit_camera({}, 1.0, {30.0, 20.0}, 45.0, 1.2));
  const RenderResult one = must_trace(near, settings);
  const glm::dvec3 shift(5.0e5, 4.2e6, 1.0e7);
  TriangleMesh far = near;
  for (glm::dvec3& p : far.positions) p += shift;
  settings.camera.eye += shift;
  settings.camera.target += shift;
  const RenderResult other = must_trace(far, settings);
  ASSERT_EQ(one.covered_pixels, other.covered_pixels);
  for (const Channel& channel : one.image.channels) {
    for (std::size_t k = 0; k < channel.values.size(); ++k) {
      const float there = values(other.image, channel.name.c_str())[k];
      // Positions are rounded to 1.9e-9; a pixel at the rim, where the depth changes by a thousand
      // times the shift across, still keeps 1e-5.
      const bool nothing = std::isinf(channel.values[k]);
      ASSERT_EQ(nothing, std::isinf(there)) << channel.name;
      EXPECT_TRUE(nothing || std::abs(channel.values[k] - there) < 1e-5F) << channel.name;
    }
  }
}

TEST(RayTracedSphere, TinyAndHugeUnitsGiveTheSameImage) {
  const TriangleMesh mesh = test::sphere_mesh(24);
  const RenderResult one =
      must_trace(mesh, test::traced_image(orbit_camera({}, 1.0, {30.0, 20.0}, 45.0, 1.2)));
  for (const double unit : {std::exp2(-70.0), std::exp2(90.0)}) {
    TriangleMesh scaled = mesh;
    for (glm::dvec3& p : scaled.positions) p *= unit;
    const RenderResult other =
        must_trace(scaled, test::traced_image(orbit_camera({}, unit, {30.0, 20.0}, 45.0, 1.2)));
    // A power of two changes no digit.
    EXPECT_EQ(values(one.image, "R"), values(other.image, "R")) << unit;
    EXPECT_EQ(values(one.image, "N.X"), values(other.image, "N.X")) << unit;
  }
}

}  // namespace
}  // namespace relief
