// Poses of range scans: what .conf files say, and that scans so placed lie on one surface.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <glm/geometric.hpp>

#include "common/neighbours/radius_search.h"
#include "preprocess/readers/read_points.h"
#include "preprocess/readers/scan_poses.h"

namespace relief {
namespace {

namespace fs = std::filesystem;

std::string failure(std::string_view text) {
  const auto poses = read_scan_poses("a.conf", text);
  return poses ? "no error" : poses.error().message;
}

TEST(ScanPoses, TheQuaternionIsThatOfTheWayBack) {
  // A quarter turn about +Z, which takes x to y: the file's points are turned the other way.
  const auto poses = read_scan_poses(
      "a.conf", "camera 0 0 1 0 0 0 1\r\n\n# a comment\nbmesh a.ply 1 2 3 0 0 0.70711 0.70711\r\n");
  ASSERT_TRUE(poses) << poses.error().message;
  ASSERT_EQ(poses->size(), 1U);
  EXPECT_EQ(poses->front().file, "a.ply");
  Points scan;
  scan.positions = {{1.0, 0.0, 0.0}};
  scan.normals = {{0.0F, 1.0F, 0.0F}};
  scan.viewpoint = glm::dvec3(0.0, 0.0, 5.0);
  place_scan(poses->front(), scan);
  EXPECT_LT(glm::distance(scan.positions[0], glm::dvec3(1.0, 1.0, 3.0)), 1e-12);
  EXPECT_LT(glm::distance(scan.normals[0], glm::vec3(1.0F, 0.0F, 0.0F)), 1e-6F);
  EXPECT_LT(glm::distance(*scan.viewpoint, glm::dvec3(1.0, 2.0, 8.0)), 1e-12);
}

TEST(ScanPoses, WhatIsNoPoseIsRefusedWithItsLine) {
  const std::string good = "bmesh a.ply 0 0 0 0 0 0 1\n";
  EXPECT_EQ(failure(good), "no error");
  EXPECT_EQ(failure(""), "a.conf: names no scan (bmesh FILE ...)");
  for (const char* line : {"bmesh", "bmesh a.ply 0 0 0 0 0 0", "bmesh a.ply 0 0 0 0 0 0 2",
                           "bmesh a.ply 0 0 0 0 0 0 0", "bmesh a.ply 0 nan 0 0 0 0 1",
                           "bmesh a.ply inf 0 0 0 0 0 1", "bmesh a.ply 0 0 0 0 0 nan 1"}) {
    EXPECT_EQ(failure(good + line).find("a.conf: line 2: expected bmesh FILE"), 0U) << line;
  }
  std::string many;
  for (int k = 0; k < 1001; ++k) many += good;
  EXPECT_EQ(failure(many), "a.conf: names more than 1000 scans");
}

TEST(ScanPoses, ScansAreOnlyLookedForBesideTheFile) {
  EXPECT_EQ(*find_scan("there/a.conf", {.file = "b.ply"}), fs::path("there/b.ply"));
  EXPECT_EQ(*find_scan("there/a.conf", {.file = "../../etc/b.PLY"}), fs::path("there/b.PLY"));
  for (const char* name : {"b.conf", "a", "b.ply/..", "/etc/passwd"})
    EXPECT_FALSE(find_scan("there/a.conf", {.file = name})) << name;
}

/// Median distance of every tenth point to the nearest vertex, at most 5 mm.
double median_distance(const Points& scan, const Points& mesh) {
  const RadiusSearch search(mesh.positions);
  std::vector<double> distances;
  std::vector<std::uint32_t> found;
  for (std::size_t i = 0; i < scan.size(); i += 10) {
    search.find(scan.positions[i], 0.005, found);
    double nearest = 0.005;
    for (const std::uint32_t j : found)
      nearest = std::min(nearest, glm::distance(scan.positions[i], mesh.positions[j]));
    distances.push_back(nearest);
  }
  std::ranges::sort(distances);
  return distances[distances.size() / 2];
}

TEST(ScanPoses, TheBunnysScansLieOnTheBunny) {
  const fs::path folder = fs::path(RELIEF_SOURCE_DIR) / "../shared/data/scans/bunny";
  if (!fs::exists(folder)) {
    GTEST_SKIP() << "needs the range scans in ../shared/data/scans/bunny beside the checkout";
  }
  const fs::path conf = folder / "range/bun.conf";
  std::string text(fs::file_size(conf), '\0');
  std::ifstream(conf).read(text.data(), static_cast<std::streamsize>(text.size()));
  const auto poses = read_scan_poses(conf.string(), text);
  ASSERT_TRUE(poses) << poses.error().message;
  EXPECT_EQ(poses->size(), 10U);
  Progress progress;
  const auto mesh = read_points(folder / "bun_zipper.ply.gz", progress);
  ASSERT_TRUE(mesh);
  for (const ScanPose& pose : *poses) {
    auto scan = read_points(*find_scan(conf, pose), progress);
    ASSERT_TRUE(scan) << scan.error().message;
    Points placed = scan->points;
    place_scan(pose, placed);
    // Vertices are 1.2 mm apart: a point of the surface is 0.45 mm from the nearest one.
    EXPECT_LT(median_distance(placed, mesh->points), 0.0007) << pose.file;
    // Turned the other way about (all but bun000, whose pose is none, and bun180, a half turn).
    if (pose.file == "bun000.ply" || pose.file == "bun180.ply") continue;
    ScanPose other = pose;
    other.turn = glm::conjugate(pose.turn);
    place_scan(other, scan->points);
    EXPECT_GT(median_distance(scan->points, mesh->points), 0.0015) << pose.file;
  }
}

}  // namespace
}  // namespace relief
