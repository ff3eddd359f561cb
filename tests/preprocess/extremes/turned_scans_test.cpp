// Conversions of scans that lie in any direction.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>

#include "preprocess/convert.h"
#include "preprocess/working_frame.h"
#include "tests/preprocess/surfaces.h"

namespace relief {
namespace {

glm::dmat3 turn(double degrees, const glm::dvec3& about) {
  return glm::mat3_cast(glm::angleAxis(glm::radians(degrees), glm::normalize(about)));
}

/// A bent torus, no two of whose directions are alike.
Points bent_torus() {
  Points points = test::sample_torus({}, 0.06);
  points.normals.clear();
  for (glm::dvec3& p : points.positions)
    p = {1.4 * p.x + 0.2 * p.y * p.y, p.y + 0.15 * p.x * p.x, 0.8 * p.z + 0.1 * p.x * p.y};
  return points;
}

Points turned(Points points, const glm::dmat3& matrix) {
  for (glm::dvec3& p : points.positions) p = matrix * p;
  for (glm::vec3& n : points.normals) n = matrix * glm::dvec3(n);
  return points;
}

PatchModel model_of(const Points& points, const ConvertOptions& options = {}) {
  Progress progress;
  Result<ConvertResult> result = convert(points, options, progress);
  if (result) return std::move(result->model);
  ADD_FAILURE() << result.error().message;
  return {};
}

/// Every sample is where it was before the turn, but for the last step of its height.
void expect_turned(const PatchModel& before, const PatchModel& after, const glm::dmat3& matrix) {
  ASSERT_EQ(before.patches.size(), after.patches.size());
  for (std::size_t p = 0; p < before.patches.size(); ++p) {
    const Patch& a = before.patches[p];
    const Patch& b = after.patches[p];
    ASSERT_EQ(a.width, b.width);
    ASSERT_EQ(a.height, b.height);
    for (std::uint32_t j = 0; j < a.height; ++j) {
      for (std::uint32_t i = 0; i < a.width; ++i) {
        ASSERT_EQ(a.at(i, j) == kHole, b.at(i, j) == kHole);
        if (a.at(i, j) == kHole) continue;
        const double off = glm::distance(matrix * position_of(a, i, j), position_of(b, i, j));
        ASSERT_LE(off, 1.001 * a.height_step);
      }
    }
  }
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

glm::dvec3 mean_normal(const PatchModel& model) {
  glm::dvec3 sum(0.0);
  for (const Patch& patch : model.patches) sum += patch.axes[2];
  return sum;
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
