#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "preprocess/raster/raster.h"
#include "preprocess/readers/source.h"
#include "preprocess/readers/text_cursor.h"

namespace relief {
namespace {

constexpr std::string_view kSeparators = " \t\f\v,;";
/// Fewer columns are points, each with its attributes.
constexpr std::size_t kFewestColumns = 16;
constexpr double kNoData = std::numeric_limits<double>::quiet_NaN();

class GridText final : public HeightRaster {
 public:
  GridText(RasterInfo info, std::vector<double> heights)
      : info_(std::move(info)), heights_(std::move(heights)) {}

  [[nodiscard]] const RasterInfo& info() const override { return info_; }
  Status read(const RasterWindow& window, std::span<double> heights) override {
    for (std::size_t row = 0; row < window.rows; ++row) {
      const std::size_t from = (window.row + row) * info_.columns + window.column;
      std::copy_n(heights_.begin() + static_cast<std::ptrdiff_t>(from), window.columns,
                  heights.begin() + static_cast<std::ptrdiff_t>(row * window.columns));
    }
    return {};
  }

 private:
  RasterInfo info_;
  std::vector<double> heights_;
};

/// Counts the numbers of the cursor's line; 0 if something else is in it.
std::size_t count_numbers(TextCursor& cursor) {
  std::size_t count = 0;
  double value = 0.0;
  while (cursor.number(value)) ++count;
  return cursor.at_line_end() ? count : 0;
}

}  // namespace

bool is_grid_text(std::string_view text) {
  TextCursor cursor(text, kSeparators);
  if (!cursor.next_line()) return false;
  const std::size_t first = count_numbers(cursor);
  if (first < kFewestColumns || !cursor.next_line()) return false;
  return count_numbers(cursor) == first;
}

Result<std::unique_ptr<HeightRaster>> read_grid_text(const std::string& name, std::string_view text,
                                                     Progress& progress) {
  progress.begin_stage("read", text.size());
  TextCursor cursor(text, kSeparators);
  std::vector<double> heights;
  std::size_t columns = 0;
  std::size_t rows = 0;
  std::size_t reported = 0;
  while (cursor.next_line()) {
    const std::size_t begin = heights.size();
    double value = 0.0;
    while (cursor.number(value)) heights.push_back(std::isfinite(value) ? value : kNoData);
    if (!cursor.at_line_end()) return make_error("{}: {}", name, cursor.expected("a height"));
    const std::size_t count = heights.size() - begin;
    if (rows == 0) columns = count;
    if (count != columns) {
      return make_error("{}: line {}: has {} heights, but the lines before it have {}", name,
                        cursor.line_number(), count, columns);
    }
    ++rows;
    progress.advance(cursor.offset() - reported);
    reported = cursor.offset();
    if (progress.cancelled()) return interrupted_error();
  }
  if (columns < 2 || rows < 2) {
    return make_error("{}: has {} columns and {} rows of heights; a grid has at least 2 of each",
                      name, columns, rows);
  }
  RasterInfo info;
  info.name = name;
  info.columns = static_cast<std::uint32_t>(columns);
  info.rows = static_cast<std::uint32_t>(rows);
  info.grid.y = static_cast<double>(rows - 1);
  info.has_coordinates = false;
  return std::unique_ptr<HeightRaster>(
      std::make_unique<GridText>(std::move(info), std::move(heights)));
}

}  // namespace relief
