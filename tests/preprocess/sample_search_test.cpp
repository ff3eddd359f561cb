// The search for the fewest samples that reach an error.
#include "preprocess/sample_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace relief {
namespace {

struct Found {
  double samples = 0.0;
  double error = 0.0;
  int trials = 0;
};

/// Searches a scan of 10,000 points whose error `error_of` tells.
Found search_for(double wanted, const std::function<double(double)>& error_of) {
  SampleSearch search(wanted, 10000.0);
  Found found;
  while (const auto samples = search.next()) {
    ++found.trials;
    const double error = error_of(*samples);
    if (search.note(*samples, *samples, error)) {
      found.samples = *samples;
      found.error = error;
    }
  }
  return found;
}

TEST(SampleSearch, FindsTheFewestSamplesOfASmoothSurface) {
  for (const double wanted : {0.3, 1.0, 5.0, 60.0}) {
    const Found found = search_for(wanted, [](double samples) { return 1e4 / samples; });
    EXPECT_LE(found.error, wanted);
    EXPECT_GE(found.error, 0.95 * wanted) << found.samples;
    EXPECT_LE(found.trials, 4);
  }
}

TEST(SampleSearch, FindsThemWhereErrorsFallInAnotherWay) {
  for (const double power : {0.5, 0.7, 1.6}) {
    const Found found =
        search_for(0.6, [&](double samples) { return std::pow(samples / 1e4, -power); });
    EXPECT_LE(found.error, 0.6) << power;
    EXPECT_GE(found.error, 0.9 * 0.6) << power;
  }
}

TEST(SampleSearch, FindsFewWhereErrorsDoNotFallEvenly) {
  // By turns a third larger and smaller, as where grids happen to meet edges.
  for (const double wanted : {0.2, 0.5, 2.0, 10.0}) {
    const auto error_of = [](double samples) {
      return 1e4 / samples * (static_cast<int>(50.0 * std::log(samples)) % 2 == 0 ? 1.33 : 0.75);
    };
    const Found found = search_for(wanted, error_of);
    EXPECT_LE(found.error, wanted);
    // Where all errors were a third larger, 1.33e4 / wanted would be found.
    EXPECT_LE(found.samples, 1.5 * 1.33e4 / wanted);
  }
}

TEST(SampleSearch, EndsWhereThePointsTellNoMore) {
  // Noise that no number of samples takes away.
  const Found found = search_for(0.1, [](double samples) { return 1.0 + 1e4 / samples; });
  EXPECT_DOUBLE_EQ(found.samples, kFinestSamplesPerPoint * 10000.0);
}

TEST(SampleSearch, EndsWhereNoFewerAreMade) {
  SampleSearch search(1.0, 10000.0);
  int trials = 0;
  while (const auto samples = search.next()) {
    ++trials;
    search.note(*samples, std::max(*samples, 5000.0), 1e-3);
  }
  EXPECT_EQ(trials, 3);
}

TEST(SampleSearch, EndsWithFewSamplesOfAPlane) {
  const Found found = search_for(1.0, [](double) { return 0.0; });
  EXPECT_DOUBLE_EQ(found.samples, 64.0);
  EXPECT_LE(found.trials, 6);
}

}  // namespace
}  // namespace relief
