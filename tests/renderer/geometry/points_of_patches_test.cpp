// The surface of patches that meet at seams as one mesh.
#include "renderer/geometry/meshes/points_of_patches.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <set>
#include <utility>

#include "common/octahedral.h"
#include "common/patch.h"
#include "common/transform.h"
#include "renderer/geometry/meshes/mesh_of_patches.h"

namespace relief {
namespace {

constexpr std::uint32_t kSide = 8;

/// A cube with one patch a face, whose samples are half a spacing from its edges.
PatchModel patches_of_cube() {
  PatchModel model;
  const double half = 0.5 * kSide;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {1.0, -1.0}) {
      Patch patch;
      patch.axes[2] = glm::dvec3(0.0);
      patch.axes[2][axis] = sign;
      patch.axes[0] = glm::dvec3(0.0);
      patch.axes[0][(axis + 1) % 3] = 1.0;
      patch.axes[1] = glm::cross(patch.axes[2], patch.axes[0]);
      patch.origin = patch.axes * glm::dvec3(0.5 - half, 0.5 - half, half);
      patch.height_step = 0.05;
      patch.width = kSide;
      patch.height = kSide;
      patch.heights.assign(std::size_t{kSide} * kSide, 0);
      patch.normals = {
          kSide, kSide, 1,
          std::vector<glm::i16vec2>(patch.heights.size(), snorm16_from_unit({0.0F, 0.0F, 1.0F}))};
      patch.colours = {
          kSide, kSide, 1,
          std::vector<glm::u8vec3>(patch.heights.size(),
                                   axis == 0 ? glm::u8vec3(255, 0, 0) : glm::u8vec3(0, 0, 255))};
      model.patches.push_back(std::move(patch));
    }
  }
  model.joined = {{0, static_cast<std::uint32_t>(model.patches.size())}};
  model.spacing = 1.0;
  model.has_colours = true;
  return model;
}

/// How often each directed edge occurs.
std::map<std::pair<std::uint32_t, std::uint32_t>, int> directed_edges(const Points& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t c = 0; c < 3; ++c) ++edges[{t[c], t[(c + 1) % 3]}];
  }
  return edges;
}

TEST(PointsOfPatches, WeldPatchesThatMeetToAClosedMesh) {
  const auto mesh = surface_mesh(patches_of_cube());
  ASSERT_TRUE(mesh);
  const auto edges = directed_edges(*mesh);
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_TRUE(edges.contains({edge.second, edge.first}));
  }
  // Euler: it is one sphere.
  EXPECT_EQ(mesh->size() + mesh->triangles.size(), edges.size() / 2 + 2);
  double volume = 0.0;
  std::set<std::uint32_t> used;
  for (const Triangle& t : mesh->triangles) {
    used.insert(t.begin(), t.end());
    const glm::dvec3 a = mesh->positions[t[0]];
    const glm::dvec3 normal = glm::cross(mesh->positions[t[1]] - a, mesh->positions[t[2]] - a);
    EXPECT_GT(glm::length(normal), 1e-3);
    volume += glm::dot(a, normal) / 6.0;
  }
  EXPECT_EQ(used.size(), mesh->size());
  // Its edges and corners are at most cut off by half a cell.
  EXPECT_LE(volume, std::pow(kSide, 3) + 1e-9);
  EXPECT_GT(volume, std::pow(kSide, 3) - 12 * kSide * 0.125);
}

TEST(PointsOfPatches, GiveASeamTheMeanOfItsPatches) {
  const auto mesh = surface_mesh(patches_of_cube());
  ASSERT_TRUE(mesh);
  ASSERT_EQ(mesh->normals.size(), mesh->size());
  ASSERT_EQ(mesh->colours.size(), mesh->size());
  int found = 0;
  for (std::size_t v = 0; v < mesh->size(); ++v) {
    EXPECT_NEAR(glm::length(mesh->normals[v]), 1.0F, 1e-5F);
    const glm::dvec3 p = mesh->positions[v];
    if (p.x != 0.5 * kSide || p.y != 0.5 * kSide || std::abs(p.z) > 2.0) continue;
    // On the edge between the faces +x and +y.
    ++found;
    EXPECT_NEAR(mesh->normals[v].x, std::sqrt(0.5), 1e-4);
    EXPECT_NEAR(mesh->normals[v].y, std::sqrt(0.5), 1e-4);
    // Half of 255, which is linear, as sRGB.
    EXPECT_EQ(mesh->colours[v], glm::u8vec3(188, 0, 188));
  }
  EXPECT_GT(found, 0);
}

TEST(PointsOfPatches, LeaveIslandsOutOfAClosedMesh) {
  PatchModel model = patches_of_cube();
  const auto alone = surface_mesh(model);
  Patch island = model.patches.front();
  island.origin += 5.0 * island.axes[2];
  for (std::uint32_t node = 0; node < island.heights.size(); ++node) {
    const std::uint32_t i = node % kSide;
    const std::uint32_t j = node / kSide;
    if (i < 3 || i > 5 || j < 3 || j > 5) island.heights[node] = kHole;
  }
  model.patches.push_back(island);
  ++model.joined.front().count;
  const auto open = surface_mesh(model);
  model.joined.front().is_closed = true;
  const auto closed = surface_mesh(model);
  ASSERT_TRUE(alone && open && closed);
  EXPECT_EQ(open->triangles.size(), alone->triangles.size() + 8);
  EXPECT_EQ(closed->triangles, alone->triangles);
  EXPECT_EQ(closed->size(), alone->size());
}

TEST(PointsOfPatches, AreTheSamplesAlone) {
  PatchModel model = patches_of_cube();
  model.patches[0].heights[9] = kHole;
  const auto points = sample_points(model);
  ASSERT_TRUE(points);
  EXPECT_EQ(points->size(), count_samples(model));
  EXPECT_EQ(points->normals.size(), points->size());
  EXPECT_EQ(points->colours.size(), points->size());
  EXPECT_TRUE(points->triangles.empty());
}

TEST(MeshOfPatches, BodiesBeginBehindTheSeamsOfThoseBefore) {
  PatchModel model = patches_of_cube();
  const auto count = static_cast<std::uint32_t>(model.patches.size());
  model.instances = {{0, count, {}, 0}, {0, count, {}, 0}};
  const auto mesh = mesh_of_patches(bake(model));
  ASSERT_TRUE(mesh);
  const std::vector<MeshBody> bodies = bodies_of(model, *mesh);
  ASSERT_EQ(bodies.size(), 2U);
  EXPECT_EQ(bodies[0].first, 0U);
  EXPECT_EQ(2 * std::size_t{bodies[1].first}, mesh->positions.size());
  EXPECT_GT(bodies[1].first, count_samples(patches_of_cube()));
}

TEST(PointsOfPatches, LeaveOverlappingPatchesAsTheyAre) {
  PatchModel model = patches_of_cube();
  model.joined.clear();
  const auto mesh = surface_mesh(model);
  ASSERT_TRUE(mesh);
  EXPECT_EQ(mesh->size(), count_samples(model));
  EXPECT_EQ(mesh->triangles.size(), model.patches.size() * 2 * (kSide - 1) * (kSide - 1));
}

}  // namespace
}  // namespace relief
