#include "common/scalars/quantise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

namespace relief {
namespace {

std::vector<double> ramp(double from, double step, int count) {
  std::vector<double> values;
  for (int k = 0; k < count; ++k) values.push_back(from + step * k);
  return values;
}

double largest_error(const PointScalar& scalar, const ScalarInfo& info) {
  double largest = 0.0;
  for (const double value : scalar.values)
    largest = std::max(largest, std::abs(info.value_of(code_of(info, value)) - value));
  return largest;
}

TEST(Quantise, KeepsWholeNumbersExactly) {
  const PointScalar intensity{"intensity", false, ramp(17, 1, 60000)};
  const auto info = describe_scalar(intensity);
  ASSERT_TRUE(info);
  EXPECT_EQ(largest_error(intensity, *info), 0.0);
  const PointScalar negative{"angle", false, {-90, 3, 90}};
  EXPECT_EQ(largest_error(negative, *describe_scalar(negative)), 0.0);
}

TEST(Quantise, RoundsNumbersToTheirRange) {
  // GPS times: seven digits before the point.
  const PointScalar time{"gps_time", false, ramp(245379.398, 0.0131, 5000)};
  const auto info = describe_scalar(time);
  ASSERT_TRUE(info);
  const double range = time.values.back() - time.values.front();
  // Half a step, and the rounding of doubles at 2e5.
  EXPECT_LE(largest_error(time, *info), 0.5 * range / 65534 + 1e-9);
}

TEST(Quantise, OneWrongNumberDoesNotTakeTheSteps) {
  PointScalar time{"gps_time", false, ramp(3e8, 0.01, 5000)};
  time.values[100] = 0.0;
  const auto info = describe_scalar(time);
  ASSERT_TRUE(info);
  // The middle 96 % are 48 wide; the range reaches 16 times that below them.
  EXPECT_LE(info->step, 17.1 * 48.0 / 65534);
  EXPECT_EQ(code_of(*info, 0.0), 0);
  EXPECT_NEAR(info->value_of(code_of(*info, time.values[2500])), time.values[2500], info->step);
}

TEST(Quantise, HandlesNumbersOfAnyKind) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(describe_scalar({"a", false, {}}));
  EXPECT_FALSE(describe_scalar({"a", false, {nan, nan}}));
  for (const auto& values :
       {std::vector<double>{0.1, 0.1}, {1e308, -1e308, 0.5}, {5e-324, 0.0}, {1e300, 1e300}}) {
    const PointScalar scalar{"a", false, values};
    const auto info = describe_scalar(scalar);
    ASSERT_TRUE(info);
    EXPECT_GT(info->step, 0.0);
    EXPECT_TRUE(std::isfinite(info->value_of(kMaxScalarCode))) << values[0];
    for (const double value : values) EXPECT_LE(code_of(*info, value), kMaxScalarCode);
    EXPECT_EQ(code_of(*info, nan), kNoScalar);
  }
}

TEST(Quantiles, AreThoseOfTheFiniteValues) {
  std::vector<double> values = ramp(0, 1, 1001);
  values.push_back(std::numeric_limits<double>::infinity());
  values.push_back(std::numeric_limits<double>::quiet_NaN());
  const auto quantiles = find_quantiles(values);
  ASSERT_TRUE(quantiles);
  EXPECT_EQ(quantiles->front(), 0.0);
  EXPECT_EQ((*quantiles)[50], 500.0);
  EXPECT_EQ(quantiles->back(), 1000.0);
  EXPECT_DOUBLE_EQ(at_percent(*quantiles, 2.5), 25.0);
  EXPECT_EQ(at_percent(*quantiles, 100.0), 1000.0);
  EXPECT_FALSE(find_quantiles(std::vector<double>{std::nan("")}));
}

}  // namespace
}  // namespace relief
