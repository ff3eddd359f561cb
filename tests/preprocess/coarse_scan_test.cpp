// Conversion of meshes of few points.
#include "preprocess/coarse_scan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "common/mesh/creases.h"
#include "common/octahedral.h"
#include "common/seams/make_seams.h"
#include "preprocess/convert.h"
#include "tests/common/mesh/bodies.h"

namespace relief {
namespace {

ConvertResult converted(const Points& points, const ConvertOptions& options = {}) {
  Progress progress;
  Result<ConvertResult> result = convert(points, options, progress);
  EXPECT_TRUE(result) << result.error().message;
  return std::move(*result);
}

Seams seams_of(const PatchModel& model) {
  return make_seams(model.patches, model.joined.front().is_closed);
}

TEST(CoarseScan, ACubeIsSixPlanesThatMeetInItsEdgesAndCorners) {
  const ConvertResult result = converted(test::cube());
  EXPECT_EQ(result.report.points, 8U);
  EXPECT_GT(result.report.points_added, 50'000U);
  ASSERT_EQ(result.model.patches.size(), 6U);
  EXPECT_TRUE(result.model.is_closed);
  EXPECT_LT(result.report.error_max, 1e-9);
  for (const Patch& patch : result.model.patches) {
    for (std::size_t k = 0; k < patch.heights.size(); ++k) {
      if (patch.heights[k] == kHole) continue;
      const glm::dvec3 normal(unit_from_snorm16(patch.normals.texels[k]));
      EXPECT_GT(normal.z, 1.0 - 1e-6);
    }
  }
  // All vertices between two patches lie on an edge, and eight in the corners.
  std::size_t corners = 0;
  for (const SeamVertex& vertex : seams_of(result.model).vertices) {
    const glm::dvec3 p = glm::abs(vertex.position);
    const int at_one = (std::abs(p.x - 1.0) < 1e-9 ? 1 : 0) + (std::abs(p.y - 1.0) < 1e-9 ? 1 : 0) +
                       (std::abs(p.z - 1.0) < 1e-9 ? 1 : 0);
    EXPECT_GE(at_one, 2) << p.x << ' ' << p.y << ' ' << p.z;
    corners += at_one == 3 ? 1 : 0;
  }
  EXPECT_EQ(corners, 8U);
}

TEST(CoarseScan, ATetrahedronOfMixedTrianglesHasSharpEdges) {
  Points mesh;
  mesh.positions = {{0, 0, 0}, {0, 1, 1}, {1, 0, 1}, {1, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 1, 3}, {1, 2, 3}};  // two face inward
  const ConvertResult result = converted(mesh);
  ASSERT_EQ(result.model.patches.size(), 4U);
  EXPECT_TRUE(result.model.is_closed);
  // Heights are multiples of a twentieth of a spacing.
  EXPECT_LT(result.report.error_max, 0.025 * result.model.spacing);
  // Above the faces: outward normals, and offsets from the middle.
  const auto height_over_faces = [](glm::dvec3 p) {
    const double third = 1.0 / std::sqrt(3.0);
    glm::dvec4 heights;
    const std::array<glm::dvec3, 4> normals{{{-third, -third, third},
                                             {third, -third, -third},
                                             {-third, third, -third},
                                             glm::dvec3(third)}};
    for (int f = 0; f < 4; ++f)
      heights[f] = glm::dot(p - 0.5, normals[static_cast<std::size_t>(f)]) - third / 2.0;
    return heights;
  };
  for (const SeamVertex& vertex : seams_of(result.model).vertices) {
    const glm::dvec4 heights = glm::abs(height_over_faces(vertex.position));
    int on_faces = 0;
    for (int f = 0; f < 4; ++f) on_faces += heights[f] < 1e-9 ? 1 : 0;
    EXPECT_GE(on_faces, 2);
  }
}

TEST(CoarseScan, TheRimOfABoreIsRound) {
  const ConvertResult result = converted(test::ring(48, 1.0));
  EXPECT_TRUE(result.model.is_closed);
  // A strip of the bore is 0.13 wide and off its circle by 0.002 in the middle. Spacings are up to
  // 0.025; samples lie up to one before the rim.
  std::size_t on_rim = 0;
  std::size_t off_surface = 0;
  for (const SeamVertex& vertex : seams_of(result.model).vertices) {
    const double radius = std::hypot(vertex.position.x, vertex.position.y);
    const double z = vertex.position.z;
    if (std::min(std::abs(z), std::abs(z - 1.0)) > 0.05 || std::abs(radius - 1.0) > 0.05) continue;
    // Two patches may meet on the wall, too, or on the end.
    const bool is_on_wall = std::abs(radius - 0.999) < 0.004;
    const bool is_on_end = std::min(std::abs(z), std::abs(z - 1.0)) < 0.003;
    if (is_on_wall && is_on_end) ++on_rim;
    if (!is_on_wall && !is_on_end) ++off_surface;
  }
  EXPECT_GT(on_rim, 400U);
  EXPECT_EQ(off_surface, 0U);
}

TEST(CoarseScan, GivenNormalsStay) {
  // Each face a little round: its normals lean outward by 20 degrees at the corners.
  Points mesh = test::cube();
  split_at_creases(mesh);
  for (std::size_t i = 0; i < mesh.size(); ++i) {
    const glm::vec3 n = mesh.normals[i];
    const glm::vec3 outward = glm::vec3(mesh.positions[i]) - n;
    mesh.normals[i] = glm::normalize(n + std::tan(glm::radians(20.0F)) * glm::normalize(outward));
  }
  const ConvertResult result = converted(mesh);
  EXPECT_FALSE(result.report.normals_estimated);
  EXPECT_EQ(result.model.patches.size(), 6U);
  EXPECT_TRUE(result.model.is_closed) << "positions count, not points";
  double farthest = 0.0;
  for (const Patch& patch : result.model.patches) {
    for (std::size_t k = 0; k < patch.heights.size(); ++k) {
      if (patch.heights[k] == kHole) continue;
      const glm::dvec3 normal(unit_from_snorm16(patch.normals.texels[k]));
      farthest = std::max(farthest, std::acos(normal.z));
    }
  }
  EXPECT_NEAR(glm::degrees(farthest), 20.0, 1.0);
}

TEST(CoarseScan, ASpacingAsksForMorePoints) {
  EXPECT_EQ(least_points(test::cube(), 0.0), 70'000U);
  EXPECT_EQ(least_points(test::cube(), 0.1), 70'000U);
  EXPECT_EQ(least_points(test::cube(), 0.01), 240'000U);
  EXPECT_EQ(least_points(test::cube(), 1e-9), 2'000'000U);
}

TEST(CoarseScan, LeavesScansAlone) {
  Points bare = test::cube();
  bare.triangles.clear();
  Progress progress;
  const Result<std::optional<CoarseScan>> none = take_coarse_mesh(bare, 0.0, progress);
  ASSERT_TRUE(none);
  EXPECT_FALSE(*none);
  EXPECT_EQ(bare.size(), 8U);
}

TEST(CoarseScan, ATinyTriangleBesideALargeOneIsNoScale) {
  // Most points are in one place; once the unit was their distance, and squares overflowed.
  Points mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 1e-30, 0}, {1e-30, 0, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 3, 4}};
  const ConvertResult result = converted(mesh);
  EXPECT_EQ(result.model.patches.size(), 1U);
  // At its open border samples end up to a spacing early.
  EXPECT_LT(result.report.error_max, 1.1 * result.model.spacing);
}

TEST(CoarseScan, TrianglesWithoutAnAreaAreRefused) {
  Points mesh;
  for (int k = 0; k < 20; ++k) mesh.positions.emplace_back(k, 0, 0);
  for (std::uint32_t k = 2; k < 20; ++k) mesh.triangles.push_back({k - 2, k - 1, k});
  Progress progress;
  const Result<ConvertResult> result = convert(mesh, {}, progress);
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().message.find("line"), std::string::npos) << result.error().message;
}

}  // namespace
}  // namespace relief
