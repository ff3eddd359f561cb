// Sums, PSNR and percentiles against what can be counted by hand.
#include "common/compare/statistics.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <cmath>
#include <numeric>

namespace relief {
namespace {

TEST(Statistics, RmsIsTheRootOfTheMeanSquare) {
  SquaredErrors errors;
  EXPECT_EQ(errors.rms(), 0.0);
  errors.add(3.0);
  errors.add(-4.0);
  EXPECT_DOUBLE_EQ(errors.rms(), std::sqrt(12.5));
}

TEST(Statistics, SumsDoNotDependOnTheThreads) {
  const auto row_errors = [](std::uint32_t row) {
    SquaredErrors errors;
    for (int x = 0; x < 7; ++x) errors.add(std::sin(row * 7.0 + x));
    return errors;
  };
  SquaredErrors expected;
  for (std::uint32_t row = 0; row < 1000; ++row) {
    const SquaredErrors errors = row_errors(row);
    expected.sum += errors.sum;
    expected.count += errors.count;
  }
  for (const std::size_t threads : {1, 2, 5}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const SquaredErrors errors = sum_rows(1000, row_errors);
    EXPECT_EQ(errors.sum, expected.sum) << threads;  // to the last bit
    EXPECT_EQ(errors.count, 7000U);
  }
}

TEST(Statistics, PsnrIsInDecibels) {
  EXPECT_DOUBLE_EQ(psnr_db(0.1, 1.0), 20.0);
  EXPECT_DOUBLE_EQ(psnr_db(0.02, 2.0), 40.0);
  EXPECT_EQ(psnr_db(0.0, 1.0), std::numeric_limits<double>::infinity());
}

TEST(Statistics, PercentileIsTheNearestRank) {
  std::vector<float> values(200);
  std::iota(values.rbegin(), values.rend(), 1.0F);
  EXPECT_EQ(percentile(values, 0.99), 198.0);
  EXPECT_EQ(percentile(values, 1.0), 200.0);
  EXPECT_EQ(percentile(values, 1e-9), 1.0);
  std::vector<float> one{7.0F};
  EXPECT_EQ(percentile(one, 0.99), 7.0);
}

}  // namespace
}  // namespace relief
