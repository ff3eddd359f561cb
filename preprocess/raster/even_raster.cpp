#include "preprocess/raster/even_raster.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace relief {
namespace {

/// The cubic of Catmull and Rom through four equidistant values, between the middle two.
double cubic(double a, double b, double c, double d, double t) {
  return b +
         0.5 * t * (c - a + t * (2.0 * a - 5.0 * b + 4.0 * c - d + t * (3.0 * (b - c) + d - a)));
}

/// `at(k)`: the height of cell k, NaN outside. `position`: in cells.
template <class At>
double interpolate(double position, const At& at) {
  const double floor = std::floor(position);
  const auto k = static_cast<std::int64_t>(floor);
  const double t = position - floor;
  const double b = at(k);
  if (t < 1e-9) return b;
  const double c = at(k + 1);
  const double a = at(k - 1);
  const double d = at(k + 2);
  const bool has_four = std::isfinite(a) && std::isfinite(d);
  return has_four ? cubic(a, b, c, d, t) : b + t * (c - b);
}

class EvenRaster final : public HeightRaster {
 public:
  EvenRaster(std::unique_ptr<HeightRaster> raster, glm::dvec2 cell)
      : raster_(std::move(raster)), info_(raster_->info()), is_by_row_(cell.y > cell.x) {
    ratio_ = is_by_row_ ? cell.x / cell.y : cell.y / cell.x;
    auto& count = is_by_row_ ? info_.rows : info_.columns;
    const double longer = std::floor((count - 1) / ratio_ * (1.0 + 1e-12)) + 1.0;
    count = static_cast<std::uint32_t>(std::min(longer, 4e9));
    (is_by_row_ ? info_.grid.dy : info_.grid.dx) *= ratio_;
    // Heights between cells are no whole numbers.
    info_.step /= kStepShare;
  }

  [[nodiscard]] const RasterInfo& info() const override { return info_; }

  Status read(const RasterWindow& window, std::span<double> heights) override {
    const RasterWindow source = source_of(window);
    std::vector<double> read(std::size_t{source.columns} * source.rows);
    RELIEF_TRY(raster_->read(source, read));
    const auto cell = [&](std::int64_t column, std::int64_t row) {
      column -= source.column;
      row -= source.row;
      const bool inside = column >= 0 && row >= 0 && column < source.columns && row < source.rows;
      return inside ? read[static_cast<std::size_t>(row * source.columns + column)]
                    : std::numeric_limits<double>::quiet_NaN();
    };
    std::size_t k = 0;
    for (std::uint32_t j = window.row; j < window.row + window.rows; ++j) {
      for (std::uint32_t i = window.column; i < window.column + window.columns; ++i, ++k) {
        heights[k] =
            is_by_row_
                ? interpolate(j * ratio_, [&](std::int64_t row) { return cell(i, row); })
                : interpolate(i * ratio_, [&](std::int64_t column) { return cell(column, j); });
      }
    }
    return {};
  }

 private:
  /// Heights between cells are kept to this share of the raster's own step.
  static constexpr double kStepShare = 8.0;

  /// The cells that a window is made of: two more on either side along the interpolated axis.
  [[nodiscard]] RasterWindow source_of(const RasterWindow& window) const {
    RasterWindow source = window;
    const auto stretch = [&](std::uint32_t& first, std::uint32_t& count, std::uint32_t all) {
      const auto low = static_cast<std::int64_t>(std::floor(first * ratio_)) - 1;
      const auto high = static_cast<std::int64_t>(std::floor((first + count - 1) * ratio_)) + 2;
      first = static_cast<std::uint32_t>(std::max<std::int64_t>(low, 0));
      count = static_cast<std::uint32_t>(std::min<std::int64_t>(high, all - 1)) - first + 1;
    };
    const RasterInfo& original = raster_->info();
    if (is_by_row_)
      stretch(source.row, source.rows, original.rows);
    else
      stretch(source.column, source.columns, original.columns);
    return source;
  }

  std::unique_ptr<HeightRaster> raster_;
  RasterInfo info_;
  bool is_by_row_;
  double ratio_ = 1.0;  ///< cells of the original for each of the new ones
};

}  // namespace

std::unique_ptr<HeightRaster> make_even(std::unique_ptr<HeightRaster> raster, glm::dvec2 cell) {
  return std::make_unique<EvenRaster>(std::move(raster), cell);
}

}  // namespace relief
