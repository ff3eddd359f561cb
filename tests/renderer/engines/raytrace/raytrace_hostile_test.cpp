// Meshes that are none: what comes out is defined, and never NaN.
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "tests/renderer/meshes.h"

namespace relief {
namespace {

using test::must_trace;
using test::values;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr double kHostileInfinity = std::numeric_limits<double>::infinity();

/// Renders with every material, one and several rays a pixel, and looks at every value.
void expect_finite(const TriangleMesh& mesh, const char* what) {
  for (const Material material : {Material::Unlit, Material::Lit, Material::Mirror}) {
    for (const int samples : {1, 4}) {
      RenderSettings settings =
          test::traced_image(orbit_camera({}, 1.0, {30.0, 20.0}, 45.0, 1.2), 48, 40);
      settings.material = material;
      settings.raytrace.samples = samples;
      const RenderResult result = must_trace(mesh, settings);
      for (const Channel& channel : result.image.channels) {
        for (const float value : channel.values) {
          const bool is_nothing = channel.name == "Z" && value == kHostileInfinity;
          ASSERT_TRUE(std::isfinite(value) || is_nothing) << what << ": " << channel.name;
        }
      }
    }
  }
}

TEST(HostileMesh, NothingIsAnEmptyImage) {
  TriangleMesh vertices_only = test::sphere_mesh(4);
  vertices_only.triangles.clear();
  for (const TriangleMesh& mesh : {TriangleMesh{}, vertices_only}) {
    expect_finite(mesh, "nothing");
    const RenderResult result =
        must_trace(mesh, test::traced_image(orbit_camera({}, 1.0, {}, 45.0, 1.2)));
    EXPECT_EQ(result.covered_pixels, 0U);
  }
}

TEST(HostileMesh, TrianglesWithoutAreaAreNotSeen) {
  TriangleMesh mesh;
  mesh.positions = {{-1, 0, 0}, {1, 0, 0}, {0, 0, 0}, {0.5, 0.5, 0}};
  mesh.normals.assign(4, {0, 0, 1});
  mesh.triangles = {{0, 0, 0}, {0, 1, 1}, {0, 1, 2}, {3, 3, 2}};
  expect_finite(mesh, "no area");
  const RenderResult result =
      must_trace(mesh, test::traced_image({{0, 0, 3}, {}, {0, 1, 0}, 45.0}));
  EXPECT_EQ(result.covered_pixels, 0U);
}

TEST(HostileMesh, InvalidNormalsAreReplacedByTheTriangles) {
  const std::vector<std::function<void(glm::vec3&)>> spoilers{
      [](glm::vec3& n) { n = glm::vec3(kNan); }, [](glm::vec3& n) { n = glm::vec3(0.0F); },
      [](glm::vec3& n) { n.x = std::numeric_limits<float>::infinity(); }};
  for (const auto& spoil : spoilers) {
    TriangleMesh mesh;
    test::add_sheet(mesh, {-9, -9, 0}, {18, 0, 0}, {0, 18, 0});
    for (glm::vec3& normal : mesh.normals) spoil(normal);
    expect_finite(mesh, "normals");
    const RenderResult result =
        must_trace(mesh, test::traced_image({{1, 2, 3}, {}, {0, 1, 0}, 45.0}));
    EXPECT_EQ(result.covered_pixels, 96U * 80U);
    EXPECT_EQ(values(result.image, "N.Z"), std::vector<float>(std::size_t{96} * 80, 1.0F));
  }
}

TEST(HostileMesh, OppositeNormalsCancelOutWithoutNan) {
  TriangleMesh mesh;
  test::add_sheet(mesh, {-9, -9, 0}, {18, 0, 0}, {0, 18, 0});
  mesh.normals[0] = -mesh.normals[2];
  expect_finite(mesh, "opposite normals");
}

TEST(HostileMesh, InvalidColoursAndMaterials) {
  TriangleMesh mesh = test::sphere_mesh(12);
  mesh.colours.assign(mesh.positions.size(), glm::vec4(0.5F, 0.5F, 0.5F, 0.5F));
  mesh.uvs.assign(mesh.positions.size(), glm::vec2(kNan));
  for (std::size_t k = 0; k < mesh.colours.size(); k += 3) mesh.colours[k] = glm::vec4(kNan);
  for (std::size_t k = 1; k < mesh.colours.size(); k += 3) mesh.colours[k].a = -5.0F;
  for (std::size_t k = 2; k < mesh.colours.size(); k += 9) mesh.colours[k].a = 7.0F;
  expect_finite(mesh, "colours");
}

TEST(HostileMesh, TrianglesWithNanPositionsAreDropped) {
  for (const double bad : {double{kNan}, kHostileInfinity, -kHostileInfinity}) {
    TriangleMesh mesh = test::sphere_mesh(12);
    for (std::size_t k = 0; k < mesh.positions.size(); k += 5) mesh.positions[k].y = bad;
    expect_finite(mesh, "positions");
    TriangleMesh one_good;
    test::add_sheet(one_good, {-9, -9, 0}, {18, 0, 0}, {0, 18, 0});
    one_good.positions.emplace_back(bad, 0.0, 0.0);
    one_good.normals.emplace_back(0, 0, 1);
    one_good.colours.emplace_back(1);
    one_good.triangles.insert(one_good.triangles.begin(), {0, 1, 4});
    const RenderResult result =
        must_trace(one_good, test::traced_image({{0, 0, 3}, {}, {0, 1, 0}, 45.0}));
    EXPECT_EQ(result.covered_pixels, 96U * 80U);
  }
}

TEST(HostileMesh, ExtremeCoordinates) {
  for (const double far : {1e20, 1e154, std::numeric_limits<double>::max()}) {
    TriangleMesh mesh = test::sphere_mesh(6);
    mesh.positions[15] *= far;
    mesh.positions[40] *= -far;
    expect_finite(mesh, "far");
  }
}

TEST(HostileMesh, TheEyeOnTheSurface) {
  TriangleMesh mesh;
  test::add_sheet(mesh, {-9, -9, 0}, {18, 0, 0}, {0, 18, 0});
  for (const glm::dvec3 eye : {glm::dvec3(0.0), {0.0, 0.0, 1e-300}, {9.0, 0.0, 0.0}, {20, 0, 0}}) {
    RenderSettings settings = test::traced_image({eye, {-1.0, 0.2, 0.0}, {0, 0, 1}, 45.0});
    for (const Material material : {Material::Lit, Material::Mirror}) {
      settings.material = material;
      const RenderResult result = must_trace(mesh, settings);
      for (const Channel& channel : result.image.channels) {
        for (const float value : channel.values) ASSERT_FALSE(std::isnan(value)) << channel.name;
      }
    }
  }
}

}  // namespace
}  // namespace relief
