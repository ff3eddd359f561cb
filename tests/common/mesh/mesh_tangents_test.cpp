// Tangent frames of meshes: turned and mirrored texture coordinates, seams, given tangents.
#include "common/mesh/mesh_tangents.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <memory>

#include "common/mesh/mesh_normals.h"
#include "common/mesh/normal_texture.h"

namespace relief {
namespace {

/// Single precision.
constexpr double kTangentRounding = 1e-6;

std::shared_ptr<const NormalTexture> flat_map() {
  return std::make_shared<const NormalTexture>(1, 1, std::vector<glm::i16vec3>{{0, 0, 32767}},
                                               TextureWrap::Repeat);
}

/// The unit square of z = 0, facing up, with these texture coordinates and a normal map.
template <class Texcoord>
Points square(const Texcoord& texcoord) {
  Points mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  for (const glm::dvec3& p : mesh.positions) mesh.texcoords.push_back(texcoord(glm::dvec2(p)));
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.triangle_materials = {0, 0};
  mesh.materials.resize(1);
  mesh.materials[0].normals.texture = flat_map();
  return mesh;
}

void expect_near(glm::dvec3 found, glm::dvec3 expected) {
  for (glm::length_t c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], kTangentRounding) << c;
}

TangentFrame middle_frame(const Points& mesh, std::size_t triangle = 0) {
  const std::vector<glm::vec3> normals = vertex_normals(mesh);
  const std::vector<CornerTangents> tangents = tangents_of(mesh, normals);
  const Triangle& t = mesh.triangles[triangle];
  return frame_at(tangents[triangle], {normals[t[0]], normals[t[1]], normals[t[2]]},
                  glm::dvec3(1.0 / 3.0));
}

TEST(MeshTangents, FollowTextureCoordinatesThatAreTurned) {
  for (const double degrees : {0.0, 30.0, 90.0, 200.0}) {
    const double a = degrees * std::acos(-1.0) / 180.0;
    // u grows along (cos a, sin a), three times as fast as v.
    const TangentFrame frame = middle_frame(square([a](glm::dvec2 p) {
      return glm::vec2(3.0 * (std::cos(a) * p.x + std::sin(a) * p.y),
                       -std::sin(a) * p.x + std::cos(a) * p.y);
    }));
    expect_near(frame.tangent, {std::cos(a), std::sin(a), 0.0});
    expect_near(frame.bitangent, {-std::sin(a), std::cos(a), 0.0});
    expect_near(frame.normal, {0.0, 0.0, 1.0});
  }
}

TEST(MeshTangents, MirroredTextureCoordinatesTurnTheirHandedness) {
  const TangentFrame along_u =
      middle_frame(square([](glm::dvec2 p) { return glm::vec2(1.0 - p.x, p.y); }));
  expect_near(along_u.tangent, {-1.0, 0.0, 0.0});
  expect_near(along_u.bitangent, {0.0, 1.0, 0.0});
  const TangentFrame along_v =
      middle_frame(square([](glm::dvec2 p) { return glm::vec2(p.x, 1.0 - p.y); }));
  expect_near(along_v.tangent, {1.0, 0.0, 0.0});
  expect_near(along_v.bitangent, {0.0, -1.0, 0.0});
}

TEST(MeshTangents, DoNotMixAcrossASeamThatMirrors) {
  // Two squares whose textures meet at x = 1 as in a mirror: u is |x - 1|.
  Points mesh = square([](glm::dvec2 p) { return glm::vec2(1.0 - p.x, p.y); });
  mesh.positions.push_back({2, 0, 0});
  mesh.positions.push_back({2, 1, 0});
  mesh.texcoords.emplace_back(1.0F, 0.0F);
  mesh.texcoords.emplace_back(1.0F, 1.0F);
  mesh.triangles.push_back({1, 4, 5});
  mesh.triangle_materials.push_back(0);
  const auto tangents = tangents_of(mesh, vertex_normals(mesh));
  EXPECT_EQ(tangents[0][1], glm::vec4(-1.0F, 0.0F, 0.0F, -1.0F));
  EXPECT_EQ(tangents[2][0], glm::vec4(1.0F, 0.0F, 0.0F, 1.0F));
}

TEST(MeshTangents, AreSmoothOverARoof) {
  // Two squares with a ridge at x = 1, u along the slope: there the tangent is level.
  Points mesh = square([](glm::dvec2 p) { return glm::vec2(p); });
  mesh.positions[0].z = mesh.positions[3].z = -1.0;
  mesh.positions.push_back({2, 0, -1});
  mesh.positions.push_back({2, 1, -1});
  mesh.texcoords.emplace_back(2.0F, 0.0F);
  mesh.texcoords.emplace_back(2.0F, 1.0F);
  mesh.triangles.push_back({1, 4, 5});
  mesh.triangles.push_back({1, 5, 2});
  mesh.triangle_materials.resize(4, 0);
  std::vector<glm::vec3> normals = vertex_normals(mesh);
  normals[1] = normals[2] = {0.0F, 0.0F, 1.0F};
  const auto tangents = tangents_of(mesh, normals);
  expect_near(glm::vec3(tangents[0][1]), {1.0, 0.0, 0.0});
  EXPECT_EQ(tangents[0][1], tangents[2][0]);
  // Away from it along its own side.
  expect_near(glm::vec3(tangents[0][0]), glm::normalize(glm::dvec3(1.0, 0.0, 1.0)));
}

TEST(MeshTangents, GivenOnesAreTaken) {
  Points mesh = square([](glm::dvec2 p) { return glm::vec2(p); });
  const glm::vec4 given(0.0F, 2.0F, 0.5F, -1.0F);  // neither unit nor in the plane
  mesh.corner_tangents = {{given, given, given}, CornerTangents{}};
  const TangentFrame frame = middle_frame(mesh);
  expect_near(frame.tangent, {0.0, 1.0, 0.0});
  expect_near(frame.bitangent, {1.0, 0.0, 0.0});
  // Where the file gives none they are those of the texture coordinates.
  expect_near(middle_frame(mesh, 1).tangent, {1.0, 0.0, 0.0});
}

TEST(MeshTangents, WithoutAnAreaInTheTextureTheSurfaceIsSmooth) {
  for (const float far : {0.0F, 1e30F, NAN}) {
    const TangentFrame frame =
        middle_frame(square([far](glm::dvec2 /*p*/) { return glm::vec2(far); }));
    expect_near(perturbed_normal(frame, {0.6F, 0.0F, 0.8F}, 1.0F), {0.0, 0.0, 1.0});
  }
}

TEST(MeshTangents, PerturbsByScaleAndStaysFinite) {
  const TangentFrame frame{{0.0, 1.0, 0.0}, {-1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}};
  expect_near(perturbed_normal(frame, {0.6F, 0.0F, 0.8F}, 1.0F), {0.0, 0.6, 0.8});
  expect_near(perturbed_normal(frame, {0.6F, 0.4F, 0.8F}, -2.0F),
              glm::normalize(glm::dvec3(0.8, -1.2, 0.8)));
  expect_near(perturbed_normal(frame, glm::vec3(0.0F), 1.0F), {0.0, 0.0, 1.0});
  expect_near(perturbed_normal(frame, glm::vec3(NAN), 1.0F), {0.0, 0.0, 1.0});
  expect_near(perturbed_normal({}, {0.6F, 0.0F, 0.8F}, 1.0F), {0.0, 0.0, 0.0});
}

}  // namespace
}  // namespace relief
