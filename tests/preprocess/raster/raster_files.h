// Small rasters, made for the tests.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace relief::test {

/// Heights of a raster, row by row, north first; NaN: no data.
struct TestGrid {
  std::uint32_t columns = 0;
  std::uint32_t rows = 0;
  std::vector<double> heights;

  [[nodiscard]] double at(std::uint32_t column, std::uint32_t row) const {
    return heights[std::size_t{row} * columns + column];
  }
};

/// Hills of whole units with holes in them, the same at each call.
inline TestGrid hills(std::uint32_t columns, std::uint32_t rows) {
  TestGrid grid{columns, rows, {}};
  std::uint32_t noise = 12345;
  for (std::uint32_t j = 0; j < rows; ++j) {
    for (std::uint32_t i = 0; i < columns; ++i) {
      noise = noise * 1664525U + 1013904223U;
      const double height = 1000.0 + 300.0 * std::sin(0.05 * i) * std::cos(0.031 * j) + noise % 7;
      const bool is_hole = (i > 20 && i < 30 && j < 12) || noise % 501 == 0;
      grid.heights.push_back(is_hole ? NAN : std::floor(height));
    }
  }
  return grid;
}

inline std::string csv_text(const TestGrid& grid) {
  std::string text;
  for (std::uint32_t j = 0; j < grid.rows; ++j) {
    for (std::uint32_t i = 0; i < grid.columns; ++i)
      text += fmt::format("{}{}", i == 0 ? "" : ",", grid.at(i, j));
    text += "\n";
  }
  return text;
}

/// ESRI's ASCII grid: the corner in the south-west and the side of cells.
inline std::string ascii_grid(const TestGrid& grid, double x, double y, double cell,
                              double unit = 1.0) {
  std::string text = fmt::format(
      "ncols {}\nnrows {}\nxllcorner {}\nyllcorner {}\ncellsize {}\nNODATA_value -9999\n",
      grid.columns, grid.rows, x, y, cell);
  for (std::uint32_t j = 0; j < grid.rows; ++j) {
    for (std::uint32_t i = 0; i < grid.columns; ++i) {
      const double height = grid.at(i, j);
      text += std::isnan(height) ? "-9999 " : fmt::format("{:.10g} ", height * unit);
    }
    text += "\n";
  }
  return text;
}

}  // namespace relief::test
