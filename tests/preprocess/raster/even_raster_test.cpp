#include "preprocess/raster/even_raster.h"

#include <gtest/gtest.h>

#include <cmath>

#include "preprocess/raster/height_steps.h"
#include "tests/preprocess/raster/raster_files.h"

namespace relief::test {
namespace {

std::unique_ptr<HeightRaster> raster_of(const TestGrid& grid) {
  Progress progress;
  auto raster = read_grid_text("grid", csv_text(grid), progress);
  EXPECT_TRUE(raster);
  return std::move(*raster);
}

std::vector<double> read_all(HeightRaster& raster) {
  const RasterInfo& info = raster.info();
  std::vector<double> heights(std::size_t{info.columns} * info.rows);
  EXPECT_TRUE(raster.read({0, 0, info.columns, info.rows}, heights));
  return heights;
}

TEST(EvenRasterTest, InterpolatesTheLongerSide) {
  // A cubic of the row, which the cubic through four heights is not exact for, but parabolas are.
  TestGrid grid{16, 9, {}};
  for (int j = 0; j < 9; ++j) {
    for (int i = 0; i < 16; ++i) grid.heights.push_back(i + 0.5 * j * j);
  }
  for (const bool by_row : {true, false}) {
    TestGrid used = grid;
    if (!by_row) {
      used = {16, 16, {}};
      for (int j = 0; j < 16; ++j) {
        for (int i = 0; i < 16; ++i) used.heights.push_back(j + 0.5 * i * i);
      }
    }
    const auto even = make_even(raster_of(used), by_row ? glm::dvec2(2, 5) : glm::dvec2(5, 2));
    const RasterInfo& info = even->info();
    EXPECT_EQ(by_row ? info.rows : info.columns, by_row ? 21U : 38U);
    const auto heights = read_all(*even);
    // The outermost cells have no four heights.
    for (std::uint32_t k = 3; k + 3 < (by_row ? info.rows : info.columns); ++k) {
      const double at = 0.4 * k;
      const std::size_t index =
          by_row ? k * std::size_t{16} + 7 : std::size_t{7} * info.columns + k;
      EXPECT_NEAR(heights[index], 7 + 0.5 * at * at, 1e-9) << k;
    }
  }
}

TEST(EvenRasterTest, AWindowHasTheHeightsOfTheWhole) {
  const auto even = make_even(raster_of(hills(20, 40)), {3, 4});
  const auto whole = read_all(*even);
  std::vector<double> part(std::size_t{5} * 11);
  ASSERT_TRUE(even->read({9, 17, 5, 11}, part));
  for (std::size_t j = 0; j < 11; ++j) {
    for (std::size_t i = 0; i < 5; ++i) {
      const double expected = whole[(17 + j) * 20 + 9 + i];
      const double found = part[j * 5 + i];
      EXPECT_TRUE(found == expected || (std::isnan(found) && std::isnan(expected)));
    }
  }
}

TEST(HeightStepsTest, FindsDecimals) {
  const auto step = [](std::vector<double> heights) {
    HeightSteps steps;
    steps.add(heights);
    return steps.decimal_step();
  };
  EXPECT_EQ(step({1, 2, -7, NAN}), 1.0);
  EXPECT_DOUBLE_EQ(step({1.5, 2}), 0.1);
  EXPECT_DOUBLE_EQ(step({double{2281.37F}, double{4012.02F}}), 0.01);
  EXPECT_EQ(step({1.0 / 3.0}), 0.0);
  EXPECT_EQ(step({double{2281.1234F}}), 0.0) << "single precision does not tell 0.0001 there";
}

}  // namespace
}  // namespace relief::test
