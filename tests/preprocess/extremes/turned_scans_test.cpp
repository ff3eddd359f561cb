// Conversions of scans that lie in any direction, and of mirrored ones.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "preprocess/convert.h"
#include "preprocess/frame/working_frame.h"
#include "tests/preprocess/extremes/turned_scans.h"
#include "tests/preprocess/surfaces.h"

namespace relief {
namespace {

using test::bent_torus;
using test::expect_turned;
using test::kMirror;
using test::turn;
using test::turned;

PatchModel model_of(const Points& points, const ConvertOptions& options = {}) {
  Progress progress;
  Result<ConvertResult> result = convert(points, options, progress);
  if (result) return std::move(result->model);
  ADD_FAILURE() << result.error().message;
  return {};
}

glm::dvec3 mean_normal(const PatchModel& model) {
  glm::dvec3 sum(0.0);
  for (const Patch& patch : model.patches) sum += patch.axes[2];
  return sum;
}

// Patches were cut along the world's axes: other patches for each turn.
TEST(TurnedScans, HaveTheSamePatches) {
  const Points points = bent_torus();
  const PatchModel as_it_is = model_of(points);
  EXPECT_GT(as_it_is.patches.size(), 4U);
  for (const glm::dmat3& matrix : {turn(1e-3, {0, 0, 1}), turn(90, {0, 1, 0}), turn(45, {1, 0, 0}),
                                   turn(37, {1, 2, 3}), turn(180, {1, 2, 3})})
    expect_turned(as_it_is, model_of(turned(points, matrix)), matrix);
}

// Frames were right-handed: other patches for a mirrored scan.
TEST(MirroredScans, HaveTheSamePatches) {
  const Points points = bent_torus();
  const PatchModel as_it_is = model_of(points);
  for (const glm::dmat3& matrix : {kMirror, -glm::dmat3(1.0), turn(37, {1, 2, 3}) * kMirror})
    expect_turned(as_it_is, model_of(turned(points, matrix)), matrix);
}

TEST(MirroredScans, KeepAllThatTheirMeshHas) {
  // Enough points that none are added: where, depends on the order of a triangle's corners.
  Points mesh = test::square_mesh({240, 150}, 0.0083, [](double x, double y) {
    return 0.3 * x * x + 0.2 * std::sin(2.0 * x + 3.0 * y * y);
  });
  mesh.scalars.emplace_back().name = "height";
  for (const glm::dvec3& p : mesh.positions) {
    mesh.colours.emplace_back(100.0 * p.x, 200.0 * p.y, 90);
    mesh.scalars.front().values.push_back(static_cast<float>(p.z));
  }
  const PatchModel as_it_is = model_of(mesh);
  ASSERT_TRUE(as_it_is.has_colours);
  ASSERT_EQ(as_it_is.scalars.size(), 1U);
  expect_turned(as_it_is, model_of(turned(mesh, kMirror)), kMirror);
  EXPECT_GT(mean_normal(model_of(turned(mesh, kMirror))).z, 0.0);
}

TEST(TurnedScans, HaveTheirBoundsInTheWorld) {
  const Points points = turned(bent_torus(), turn(37, {1, 2, 3}));
  const Bounds bounds = bounds_of(points.positions);
  const PatchModel model = model_of(points);
  EXPECT_EQ(model.bounds.min, bounds.min);
  EXPECT_EQ(model.bounds.max, bounds.max);
}

TEST(TurnedScans, AreFittedAsOften) {
  Progress progress;
  const Points points = bent_torus();
  const auto before = convert(points, {}, progress);
  const auto after = convert(turned(points, turn(37, {1, 2, 3})), {}, progress);
  ASSERT_TRUE(before && after);
  EXPECT_GE(before->report.fits, count_samples(before->model));
  EXPECT_EQ(before->report.fits, after->report.fits);
  EXPECT_EQ(before->report.fits_replaced, after->report.fits_replaced);
  EXPECT_LT(before->report.fit_condition, 1e7);
}

/// A sheet that is longer than it is wide, and leans.
Points leaning_sheet() {
  Points points = test::square_mesh(
      {40, 24}, 0.05, [](double x, double y) { return 0.4 * x + 0.05 * std::sin(3.0 * x) * y; });
  points.triangles.clear();
  return points;
}

TEST(TurnedScans, AreSeenFromWhereTheOptionsSay) {
  ConvertOptions options;
  options.side.side = NormalSide::Up;
  EXPECT_GT(mean_normal(model_of(leaning_sheet(), options)).z, 0.0);
  const Points over = turned(leaning_sheet(), turn(180, {1, 0, 0}));
  EXPECT_GT(mean_normal(model_of(over, options)).z, 0.0);
  for (const double z : {-9.0, 9.0}) {
    options.side = {.side = NormalSide::Toward, .toward = {1.0, 0.5, z}};
    EXPECT_GT(mean_normal(model_of(leaning_sheet(), options)).z * z, 0.0);
    Points scanned = leaning_sheet();
    scanned.viewpoint = options.side.toward;
    EXPECT_GT(mean_normal(model_of(scanned)).z * z, 0.0);
  }
}

/// The corners of a box, with one more beyond the last: it has a longer side along each axis.
std::vector<glm::dvec3> corners_of_box(const glm::dvec3& size, bool is_even = false) {
  std::vector<glm::dvec3> corners;
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) {
      for (const double z : {-1.0, 1.0}) corners.push_back(size * glm::dvec3(x, y, z));
    }
  }
  if (!is_even) corners.push_back(3.0 * size);
  return corners;
}

TEST(WorkingFrame, HasTheLongestAxisFirst) {
  const WorkingFrame frame = working_frame(corners_of_box({0.01, 1.0, 0.1}, true));
  const glm::dmat3 expected{{0, 1, 0}, {0, 0, 1}, {1, 0, 0}};
  for (int k = 0; k < 3; ++k) EXPECT_LT(glm::distance(frame.axes[k], expected[k]), 1e-12) << k;
}

TEST(WorkingFrame, TurnsWithThePoints) {
  const std::vector<glm::dvec3> corners = corners_of_box({1.0, 0.6, 0.2});
  const WorkingFrame before = working_frame(corners);
  EXPECT_GT(before.axes[0].x, 0.0);
  const glm::dmat3 matrix = turn(100, {3, 1, 2});
  std::vector<glm::dvec3> moved;
  for (const glm::dvec3& p : corners) moved.push_back(matrix * p + glm::dvec3(5.0, 6.0, 7.0));
  const WorkingFrame after = working_frame(moved);
  for (int k = 0; k < 3; ++k)
    EXPECT_LT(glm::distance(matrix * before.axes[k], after.axes[k]), 1e-12) << k;
}

TEST(WorkingFrame, IsMirroredWithThePoints) {
  std::vector<glm::dvec3> corners = corners_of_box({1.0, 0.6, 0.2});
  const WorkingFrame before = working_frame(corners);
  for (glm::dvec3& p : corners) p = kMirror * p;
  const WorkingFrame after = working_frame(corners);
  for (int k = 0; k < 3; ++k)
    EXPECT_LT(glm::distance(kMirror * before.axes[k], after.axes[k]), 1e-12) << k;
}

TEST(WorkingFrame, IsRightHandedWhereNoSideDiffers) {
  for (const glm::dvec3& size : {glm::dvec3(1.0, 0.6, 0.2), glm::dvec3(0.2, 0.6, 1.0)})
    EXPECT_NEAR(glm::determinant(working_frame(corners_of_box(size, true)).axes), 1.0, 1e-12);
}

// The v axis of a texture is w times the cross product of normal and tangent.
TEST(WorkingFrame, TurnsTrianglesOfMirroredMeshesRound) {
  Points mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  mesh.corner_texcoords = {{glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(0, 1)}};
  mesh.corner_tangents = {{glm::vec4(1, 0, 0, 1), glm::vec4(2, 0, 0, 1), glm::vec4(3, 0, 0, 1)}};
  to_working_frame({.axes = kMirror}, mesh);
  EXPECT_EQ(mesh.triangles.front(), (Triangle{0, 2, 1}));
  EXPECT_EQ(mesh.corner_texcoords.front()[1], glm::vec2(0, 1));
  EXPECT_EQ(mesh.corner_tangents.front()[0], glm::vec4(-1, 0, 0, -1));
  EXPECT_EQ(mesh.corner_tangents.front()[1], glm::vec4(-3, 0, 0, -1));
}

TEST(WorkingFrame, IsTheWorldsWhereNoDirectionDiffers) {
  EXPECT_EQ(working_frame(corners_of_box({1.0, 1.0, 1.0}, true)), WorkingFrame{});
  EXPECT_EQ(working_frame({}), WorkingFrame{});
  EXPECT_EQ(working_frame({{1e200, 0.0, 0.0}, {-1e200, 1.0, 0.0}}), WorkingFrame{});
}

TEST(WorkingFrame, KeepsTheWorldsAxesAboutASingleOne) {
  const WorkingFrame pole = working_frame(corners_of_box({0.2, 0.2, 1.0}, true));
  EXPECT_NEAR(std::abs(pole.axes[0].z), 1.0, 1e-12);
  EXPECT_NEAR(std::abs(pole.axes[1].x), 1.0, 1e-12);
  const WorkingFrame plate = working_frame(corners_of_box({1.0, 0.2, 1.0}, true));
  EXPECT_NEAR(std::abs(plate.axes[0].y), 1.0, 1e-12);
  EXPECT_NEAR(glm::determinant(plate.axes), 1.0, 1e-12);
}

}  // namespace
}  // namespace relief
