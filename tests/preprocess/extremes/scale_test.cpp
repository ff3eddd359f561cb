// Conversions of scans of any size, near and far.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "preprocess/convert.h"
#include "preprocess/frame/working_unit.h"
#include "tests/preprocess/surfaces.h"

namespace relief {
namespace {

ConvertResult must_convert(const Points& points, const ConvertOptions& options = {}) {
  Progress progress;
  Result<ConvertResult> result = convert(points, options, progress);
  if (result) return std::move(*result);
  ADD_FAILURE() << result.error().message;
  return {};
}

Points scaled(Points points, double scale) {
  for (glm::dvec3& p : points.positions) p *= scale;
  return points;
}

void expect_scaled(const ConvertResult& small, const ConvertResult& large, double scale) {
  ASSERT_EQ(small.model.patches.size(), large.model.patches.size()) << scale;
  for (std::size_t p = 0; p < small.model.patches.size(); ++p) {
    const Patch& a = small.model.patches[p];
    const Patch& b = large.model.patches[p];
    EXPECT_EQ(a.origin * scale, b.origin);
    EXPECT_EQ(a.axes, b.axes);
    EXPECT_EQ(a.spacing * scale, b.spacing);
    EXPECT_EQ(a.height_step * scale, b.height_step);
    EXPECT_EQ(a.heights, b.heights);
    EXPECT_EQ(a.normals.texels, b.normals.texels);
  }
  EXPECT_EQ(small.model.spacing * scale, large.model.spacing);
  EXPECT_EQ(small.model.bounds.max * scale, large.model.bounds.max);
  EXPECT_EQ(small.model.bounding_radius * scale, large.model.bounding_radius);
  ASSERT_EQ(small.model.extremes.size(), large.model.extremes.size());
  for (std::size_t k = 0; k < small.model.extremes.size(); ++k)
    EXPECT_EQ(small.model.extremes[k] * scale, large.model.extremes[k]);
  EXPECT_EQ(small.report.error_rms * scale, large.report.error_rms);
  EXPECT_EQ(small.report.psnr_db, large.report.psnr_db);
}

// A division by a power of two is exact, so that nothing may differ. Without a unit of its own the
// conversion made other patches from 2^-28 on, and ended by a signal at 2^-40 and at 2^100.
TEST(Scale, ByAnyPowerOfTwoGivesTheSamePatches) {
  const Points points = test::sample_torus({}, 0.06);
  const ConvertResult as_it_is = must_convert(points);
  EXPECT_LE(as_it_is.model.patches.size(), 20U);
  for (const int exponent : {-100, -40, -28, 28, 40, 100}) {
    const double scale = std::ldexp(1.0, exponent);
    expect_scaled(as_it_is, must_convert(scaled(points, scale)), scale);
  }
}

TEST(Scale, HoldsForEveryLengthAmongTheOptions) {
  const Points points = test::sample_torus({}, 0.06);
  ConvertOptions options;
  options.spacing = 0.07;
  options.height_step = 0.001;
  options.noise_removal = NoiseRemoval::AsGiven;
  options.noise = 0.01;
  options.side = {NormalSide::Toward, {0.0, 0.0, 9.0}};
  options.distances = true;
  const ConvertResult as_it_is = must_convert(points, options);
  const double scale = std::ldexp(1.0, 33);
  for (double* length : {&options.spacing, &options.height_step, &options.noise}) *length *= scale;
  options.side.toward *= scale;
  const ConvertResult large = must_convert(scaled(points, scale), options);
  expect_scaled(as_it_is, large, scale);
  EXPECT_EQ(as_it_is.report.noise * scale, large.report.noise);
  ASSERT_EQ(large.model.scalars.size(), 1U);
  EXPECT_EQ(as_it_is.model.scalars[0].step * scale, large.model.scalars[0].step);
}

TEST(Scale, OfMessagesIsThatOfTheScan) {
  Progress progress;
  ConvertOptions options;
  options.spacing = 1e-6 * 1e-9;
  const auto refused = convert(scaled(test::sample_torus({}, 0.06), 1e-9), options, progress);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("a spacing of 1e-15 would give"), std::string::npos)
      << refused.error().message;
}

TEST(Scale, IsThatOfMostPoints) {
  Points points = test::sample_torus({}, 0.06);
  const double unit = working_unit(points.positions);
  // The torus is 2.8 wide; half of its points are farther from the middle than 1.
  EXPECT_EQ(unit, 1.0);
  points.positions.emplace_back(1e12, 0.0, 0.0);
  EXPECT_EQ(working_unit(points.positions), unit);
  EXPECT_EQ(working_unit({}), 1.0);
  EXPECT_EQ(working_unit({{1.0, 2.0, 3.0}, {1.0, 2.0, 3.0}}), 1.0);
}

// Beside such a point all others were on one line.
TEST(Scale, IsNotThatOfAPointFarAway) {
  Points points = test::sample_torus({}, 0.06);
  const ConvertResult alone = must_convert(points);
  for (const double far_away : {1e9, 1e12}) {
    Points with_one = points;
    with_one.positions.emplace_back(far_away, 0.0, 0.0);
    const ConvertResult result = must_convert(with_one);
    EXPECT_EQ(result.report.stray_points, 1U);
    EXPECT_EQ(result.model.patches.size(), alone.model.patches.size());
    EXPECT_EQ(result.model.bounds.max, alone.model.bounds.max);
  }
}

// Squares of such distances are infinite: the program ended by a signal.
TEST(Scale, OfAPointBeyondAllSquaresIsRefused) {
  Progress progress;
  for (const double far_away : {1e14, 1e308}) {
    Points points = test::sample_torus({}, 0.06);
    points.positions.emplace_back(far_away, 0.0, 0.0);
    const auto refused = convert(points, {}, progress);
    ASSERT_FALSE(refused) << far_away;
    EXPECT_NE(refused.error().message.find("lie on one line"), std::string::npos);
  }
}

}  // namespace
}  // namespace relief
