// Draco: point clouds and meshes in every coding, and files that are not to be trusted.
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <random>
#include <set>

#include "tests/preprocess/readers/drc_files.h"
#include "tests/preprocess/readers/scan_files.h"

namespace relief {
namespace {

using test::kDrcColours;
using test::kDrcPositions;

/// Of the points of kDrcPositions the one at `p`. 14 bits over 2 units are 1.2e-4 a step.
std::size_t which(glm::dvec3 p) {
  for (std::size_t i = 0; i < kDrcPositions.size(); ++i) {
    const auto& q = kDrcPositions[i];
    if (glm::distance(p, glm::dvec3(q[0], q[1], q[2])) < 1.5e-4) return i;
  }
  ADD_FAILURE() << p.x << " " << p.y << " " << p.z;
  return 0;
}

std::vector<std::string> all_files() {
  return {test::drc_cloud(draco::POINT_CLOUD_SEQUENTIAL_ENCODING),
          test::drc_cloud(draco::POINT_CLOUD_KD_TREE_ENCODING),
          test::drc_mesh(draco::MESH_SEQUENTIAL_ENCODING),
          test::drc_mesh(draco::MESH_EDGEBREAKER_ENCODING)};
}

TEST(Drc, ReadsPointCloudsWithTheirAttributes) {
  for (const auto method :
       {draco::POINT_CLOUD_SEQUENTIAL_ENCODING, draco::POINT_CLOUD_KD_TREE_ENCODING}) {
    const Points points = test::read("a.drc", test::drc_cloud(method));
    ASSERT_EQ(points.size(), 4U);
    ASSERT_EQ(points.normals.size(), 4U);
    ASSERT_EQ(points.colours.size(), 4U);
    EXPECT_TRUE(points.triangles.empty());
    std::set<std::size_t> found;  // the tree gives them in another order
    for (std::size_t i = 0; i < 4; ++i) {
      const std::size_t from = which(points.positions[i]);
      found.insert(from);
      const auto& c = kDrcColours[from];
      EXPECT_EQ(points.colours[i], glm::u8vec3(c[0], c[1], c[2]));
      // 10 bits of an octahedron: a fifth of a degree.
      EXPECT_GT(points.normals[i].z, 0.9999F);
    }
    EXPECT_EQ(found.size(), 4U);
  }
}

TEST(Drc, ReadsMeshesWithTextureCoordinates) {
  for (const auto method : {draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING}) {
    const Points points = test::read("a.drc", test::drc_mesh(method));
    ASSERT_EQ(points.size(), 4U);
    ASSERT_EQ(points.texcoords.size(), 4U);
    for (std::size_t i = 0; i < 4; ++i) {
      const auto& p = kDrcPositions[which(points.positions[i])];
      EXPECT_NEAR(points.texcoords[i].x, 0.1F * p[0], 1e-6F);
      EXPECT_NEAR(points.texcoords[i].y, 0.1F * p[1], 1e-6F);
    }
    ASSERT_EQ(points.triangles.size(), 2U);
    for (const Triangle& t : points.triangles) {
      std::array<std::size_t, 3> corners{};
      for (std::size_t c = 0; c < 3; ++c) corners[c] = which(points.positions[t[c]]);
      // Equal winding, from any first corner.
      std::rotate(corners.begin(), std::ranges::min_element(corners), corners.end());
      EXPECT_TRUE((corners == std::array<std::size_t, 3>{0, 1, 2}) ||
                  (corners == std::array<std::size_t, 3>{0, 2, 3}));
    }
  }
}

TEST(Drc, IsKnownByItsFirstBytes) {
  EXPECT_EQ(test::read("a.bin", all_files()[0]).size(), 4U);
  EXPECT_EQ(test::read("a.drc.gz", test::gzip(all_files()[0])).size(), 4U);
}

TEST(Drc, IsRefusedWhereverItEnds) {
  for (const std::string& bytes : all_files()) {
    for (std::size_t length = 0; length < bytes.size(); ++length)
      EXPECT_NE(test::error("a.drc", bytes.substr(0, length)), "no error") << length;
  }
}

/// Draco has no checksum: the test asks only for no crash and no triangle with invalid points.
TEST(Drc, SurvivesDamage) {
  std::mt19937 random(1);
  for (const std::string& bytes : all_files()) {
    for (int i = 0; i < 3000; ++i) {
      std::string damaged = bytes;
      damaged[5 + random() % (bytes.size() - 5)] = static_cast<char>(random());
      const auto result = test::try_read("a.drc", damaged);
      if (!result) continue;
      for (const Triangle& t : result->points.triangles)
        ASSERT_LT(std::max({t[0], t[1], t[2]}), result->points.size());
    }
  }
}

TEST(Drc, RefusesHostileCounts) {
  std::string cloud = all_files()[0];
  cloud.replace(11, 4, test::pack(std::uint32_t{2'000'000'000}));
  EXPECT_NE(test::error("a.drc", cloud).find("states 2000000000 points"), std::string::npos);
  // Faces, as five bytes of seven bits: behind the header in place of what the mesh says of itself.
  std::string mesh = all_files()[2].substr(0, 9) + test::pack(std::uint16_t{0});
  mesh += "\xFF\xFF\xFF\xFF\x07\x04";
  mesh += std::string(20, '\1');
  EXPECT_NE(test::error("a.drc", mesh).find("2147483647 faces, which cannot be in"),
            std::string::npos)
      << test::error("a.drc", mesh);
}

TEST(Drc, RefusesOlderBitstreams) {
  std::string bytes = all_files()[0];
  bytes[6] = 1;
  EXPECT_NE(test::error("a.drc", bytes).find("has Draco bitstream 2.1"), std::string::npos);
}

}  // namespace
}  // namespace relief
