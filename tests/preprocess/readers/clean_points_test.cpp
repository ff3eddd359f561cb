#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "preprocess/readers/read_points.h"

namespace relief::test {
namespace {

using glm::dvec3;
using glm::vec3;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinite = std::numeric_limits<double>::infinity();

TEST(CleanPointsTest, LeavesCleanPointsAsTheyAre) {
  Points points;
  points.positions = {{3, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  points.triangles = {{2, 0, 1}};
  points.viewpoint = dvec3(7, 8, 9);
  const ReadResult result = clean_points(points);
  EXPECT_EQ(result.points.positions, points.positions);
  EXPECT_EQ(result.points.triangles, points.triangles);
  EXPECT_EQ(result.points.viewpoint, points.viewpoint);
  EXPECT_EQ(result.points_in_file, 3U);
  EXPECT_EQ(result.dropped_nonfinite + result.merged_duplicates, 0U);
}

TEST(CleanPointsTest, DropsNonFiniteMergesEqualAndKeepsTheOrderOfFirstAppearance) {
  Points points;
  points.positions = {{kNan, 0, 0}, {2, 0, 0}, {0, kInfinite, 0}, {1, 0, 0},
                      {2, 0, 0},    {0, 0, 0}, {-0.0, 0, -0.0}};
  points.normals = {vec3(9), {0, 0, 1}, vec3(9), {1, 0, 0}, {0, 1, 0}, vec3(NAN), {0, 0, 1}};
  points.colours = {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}, {4, 4, 4}, {5, 5, 5}, {6, 6, 6}};
  points.texcoords = {{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}, {5, 0}, {6, 0}};
  const ReadResult result = clean_points(points);
  EXPECT_EQ(result.points_in_file, 7U);
  EXPECT_EQ(result.dropped_nonfinite, 2U);
  EXPECT_EQ(result.merged_duplicates, 2U);
  EXPECT_EQ(result.points.positions, (std::vector<dvec3>{{2, 0, 0}, {1, 0, 0}, {0, 0, 0}}));
  EXPECT_EQ(result.points.normals, (std::vector<vec3>{{0, 1, 1}, {1, 0, 0}, {0, 0, 1}}));
  EXPECT_EQ(result.points.colours, (std::vector<glm::u8vec3>{{1, 1, 1}, {3, 3, 3}, {5, 5, 5}}));
  EXPECT_EQ(result.points.texcoords, (std::vector<glm::vec2>{{1, 0}, {3, 0}, {5, 0}}));
}

TEST(CleanPointsTest, RenumbersTrianglesAndDropsTheDegenerate) {
  Points points;
  points.positions = {{0, 0, 0}, {kNan, 0, 0}, {1, 0, 0}, {0, 0, 0}, {0, 1, 0}};
  points.triangles = {{0, 2, 4}, {2, 3, 4}, {0, 1, 2}, {0, 3, 4}, {0, 2, 5}, {0, 2, UINT32_MAX}};
  const ReadResult result = clean_points(points);
  EXPECT_EQ(result.points.triangles, (std::vector<Triangle>{{0, 1, 2}, {1, 0, 2}}));
}

TEST(CleanPointsTest, MergedPointsOfASeamLeaveEachTriangleItsOwnTextureCoordinates) {
  Points points;  // two triangles at an edge whose ends are written twice; a third is dropped
  points.positions = {{0, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, 0, 0}, {0, 1, 0}, {1, 0, 0}};
  points.texcoords = {{1, 0}, {1, 1}, {0.5, 0}, {0, 0}, {0, 1}, {0.5, 0}};
  points.triangles = {{0, 3, 1}, {0, 1, 2}, {4, 3, 5}};
  const ReadResult result = clean_points(points);
  ASSERT_EQ(result.points.triangles, (std::vector<Triangle>{{0, 1, 2}, {1, 0, 3}}));
  ASSERT_EQ(result.points.corner_texcoords.size(), 2U);
  EXPECT_EQ(result.points.corner_texcoords[0],
            (CornerTexcoords{glm::vec2(1, 0), glm::vec2(1, 1), glm::vec2(0.5, 0)}));
  EXPECT_EQ(result.points.corner_texcoords[1],
            (CornerTexcoords{glm::vec2(0, 1), glm::vec2(0, 0), glm::vec2(0.5, 0)}));
}

TEST(CleanPointsTest, NoPointsStayNoPoints) {
  EXPECT_EQ(clean_points({}).points.size(), 0U);
  Points points;
  points.positions.assign(5, dvec3(kNan));
  points.triangles = {{0, 1, 2}};
  const ReadResult result = clean_points(points);
  EXPECT_EQ(result.points.size() + result.points.triangles.size(), 0U);
  EXPECT_EQ(result.dropped_nonfinite, 5U);
}

TEST(CleanPointsTest, AMillionEqualPointsTakeNoLongerThanDifferentOnes) {
  // One second is 50 times what it takes; quadratic work would take an hour.
  Points points;
  points.positions.assign(1'000'000, dvec3(1, 2, 3));
  const ReadResult result = clean_points(std::move(points));
  EXPECT_EQ(result.points.size(), 1U);
  EXPECT_EQ(result.merged_duplicates, 999'999U);
}

TEST(CleanPointsTest, RepeatedTrianglesAreDroppedWithTheirAttributes) {
  Points points;
  points.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 0}};
  // The second begins elsewhere, the third with a point that is merged. The fourth faces the other
  // way, which is a side of its own.
  points.triangles = {{0, 1, 2}, {1, 2, 0}, {4, 1, 2}, {0, 2, 1}, {1, 3, 2}};
  points.triangle_materials = {7, 8, 9, 10, 11};
  const ReadResult result = clean_points(points);
  EXPECT_EQ(result.points.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 1}, {1, 3, 2}}));
  EXPECT_EQ(result.points.triangle_materials, (std::vector<std::uint32_t>{7, 10, 11}));
}

TEST(CleanPointsTest, LargeTrianglesKeepTheNormalsOfTheirCorners) {
  // Two sides of a roof, and a third triangle that goes on the second.
  Points points;
  points.positions = {{0, 0, 1}, {1, 0, 1}, {0, -1, 0}, {0, 0, 1}, {1, 0, 1},
                      {0, 1, 0}, {1, 0, 1}, {0, 1, 0},  {1, 1, 0}};
  points.normals.assign(9, vec3(0, 1, 1));
  for (const std::size_t k : {0U, 1U, 2U}) points.normals[k] = vec3(0, -1, 1);
  points.normals[6] = vec3(0, 2, 2);  // of any length
  points.triangles = {{0, 2, 1}, {3, 4, 5}, {6, 8, 7}};
  const ReadResult result = clean_points(points);
  EXPECT_EQ(result.merged_duplicates, 2U);
  EXPECT_EQ(result.points.triangles, (std::vector<Triangle>{{0, 2, 1}, {3, 4, 5}, {4, 6, 5}}));
}

TEST(CleanPointsTest, AHostileFanOfNormalsIsBounded) {
  // A million corners in one place, no two alike, and one triangle larger than all others.
  Points points;
  for (int k = 0; k < 1'000'000; ++k) {
    points.positions.emplace_back(0, 0, 0);
    points.normals.emplace_back(std::cos(0.02 * k), std::sin(0.02 * k), 1e-6 * k);
  }
  points.positions.insert(points.positions.end(), {{1, 0, 0}, {0, 1, 0}});
  points.normals.insert(points.normals.end(), 2, vec3(0, 0, 1));
  points.triangles = {{0, 1'000'000, 1'000'001}};
  EXPECT_LE(clean_points(std::move(points)).points.size(), 34U);
}

}  // namespace
}  // namespace relief::test
