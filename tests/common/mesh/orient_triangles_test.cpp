#include "common/mesh/orient_triangles.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "tests/common/mesh/bodies.h"

namespace relief {
namespace {

void turn(Points& mesh, const std::vector<std::uint8_t>& which) {
  for (std::size_t t = 0; t < which.size(); ++t) {
    if (which[t] != 0) turn_triangle(mesh, t);
  }
}

/// A cube some of whose triangles face inward.
Points mixed_cube() {
  Points mesh = test::cube();
  for (const std::size_t t : {0U, 3U, 4U, 5U, 7U, 8U, 9U, 10U}) turn_triangle(mesh, t);
  return mesh;
}

TEST(OrientTriangles, OfAClosedMeshFaceOutward) {
  Points mesh = mixed_cube();
  turn(mesh, triangles_to_turn(mesh, mesh.triangles));
  EXPECT_EQ(mesh.triangles, test::cube().triangles) << "although most of them faced inward";
}

TEST(OrientTriangles, WhatAgreesStays) {
  Points inside = test::cube();  // a room
  turn(inside, std::vector<std::uint8_t>(inside.triangles.size(), 1));
  const std::vector<std::uint8_t> none(inside.triangles.size(), 0);
  EXPECT_EQ(triangles_to_turn(inside, inside.triangles), none);
}

TEST(OrientTriangles, NormalsSayWhichSideIsOut) {
  Points mesh = mixed_cube();
  for (const glm::dvec3& p : mesh.positions) mesh.normals.emplace_back(glm::normalize(-p));
  turn(mesh, triangles_to_turn(mesh, mesh.triangles));
  Points inside = test::cube();
  turn(inside, std::vector<std::uint8_t>(inside.triangles.size(), 1));
  EXPECT_EQ(mesh.triangles, inside.triangles);
}

TEST(OrientTriangles, OfAnOpenMeshFaceAsMostDid) {
  Points mesh = test::cube();
  mesh.triangles.resize(10);  // without a face
  turn_triangle(mesh, 4);
  EXPECT_EQ(triangles_to_turn(mesh, mesh.triangles),
            (std::vector<std::uint8_t>{0, 0, 0, 0, 1, 0, 0, 0, 0, 0}));
}

TEST(OrientTriangles, AMoebiusStripStays) {
  Points mesh;
  for (int k = 0; k < 5; ++k) {
    mesh.positions.emplace_back(k, 0, 0);
    mesh.positions.emplace_back(k, 1, 0);
  }
  for (std::uint32_t k = 0; k < 8; ++k)
    mesh.triangles.push_back(k % 2 == 0 ? Triangle{k, k + 1, k + 2} : Triangle{k + 1, k, k + 2});
  mesh.triangles.push_back({8, 9, 1});  // the last rung meets the first upside down
  mesh.triangles.push_back({1, 9, 0});
  EXPECT_EQ(triangles_to_turn(mesh, mesh.triangles),
            std::vector<std::uint8_t>(mesh.triangles.size(), 0));
}

TEST(OrientTriangles, CornersKeepWhatTheyHave) {
  Points mesh = test::cube();
  mesh.corner_texcoords.assign(mesh.triangles.size(), {glm::vec2(0), glm::vec2(1), glm::vec2(2)});
  const Triangle before = mesh.triangles[1];
  turn_triangle(mesh, 1);
  EXPECT_EQ(mesh.triangles[1], (Triangle{before[0], before[2], before[1]}));
  EXPECT_EQ(mesh.corner_texcoords[1][1], glm::vec2(2));
  EXPECT_EQ(mesh.corner_texcoords[0][1], glm::vec2(1));
}

}  // namespace
}  // namespace relief
