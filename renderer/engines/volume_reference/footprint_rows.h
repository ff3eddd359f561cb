// A footprint's weights in the pixels of a row.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "renderer/volume/splats/tile_lists.h"

namespace relief::volume_reference {

/// The pixels of a row in which q is below the cutoff, and peak * exp(-q / 2) in each.
struct RowWeights {
  std::int64_t first = 0;
  std::int64_t last = -1;               ///< included; before `first` if there are none
  std::array<double, kTile> weights{};  ///< of first, first + 1, ...
};

/// A footprint, taken apart so that a row costs two exponentials whatever its length: from pixel to
/// pixel the exponent's difference grows by the same number.
class FootprintRows {
 public:
  FootprintRows(const Footprint& footprint, std::int64_t image_height)
      : footprint_(footprint),
        top_(static_cast<double>(image_height)),
        per_reach_(1.0 / footprint.reach.y),
        half_width_(std::sqrt(footprint.cutoff / footprint.xx)),
        shear_(-footprint.xy / footprint.xx),
        growth_(std::exp(-footprint.xx)) {}

  /// From the footprint's centre to the middle of a pixel.
  [[nodiscard]] glm::dvec2 from_centre(std::int64_t x, std::int64_t y) const {
    return {static_cast<double>(x) + 0.5 - footprint_.centre.x,
            top_ - static_cast<double>(y) - 0.5 - footprint_.centre.y};
  }

  /// Of row y, between two columns at most kTile apart, both included.
  void row(std::int64_t y, std::int64_t left, std::int64_t right, RowWeights& row) const {
    row.first = left;
    row.last = left - 1;
    const double dy = from_centre(left, y).y;
    const double share = dy * per_reach_;
    const double square = 1.0 - share * share;
    if (!(square > 0.0)) return;
    const double half = half_width_ * std::sqrt(square);
    // From the middle of the pixel `left`. In floating point until it is known to lie between the
    // two columns: a footprint may reach very far. Conversion to an integer rounds to zero.
    const double middle = footprint_.centre.x + shear_ * dy - 0.5 - static_cast<double>(left);
    const auto columns = static_cast<double>(right - left);
    if (!(middle + half > 0.0 && middle - half < columns)) return;
    if (middle - half >= 0.0) row.first += static_cast<std::int64_t>(middle - half) + 1;
    row.last = left + static_cast<std::int64_t>(std::min(middle + half, columns));
    if (row.last < row.first) return;
    const double dx = from_centre(row.first, y).x;
    double weight = footprint_.peak * std::exp(-0.5 * footprint_.q({dx, dy}));
    row.weights[0] = weight;
    if (row.first == row.last) return;
    double ratio = std::exp(-(footprint_.xx * (dx + 0.5) + footprint_.xy * dy));
    const auto count = static_cast<std::size_t>(row.last - row.first + 1);
    for (std::size_t i = 1; i < count; ++i) {
      weight *= ratio;
      ratio *= growth_;
      row.weights[i] = weight;
    }
  }

 private:
  const Footprint& footprint_;
  double top_;         ///< of the image, pixels from its lower edge
  double per_reach_;   ///< 1 / half the height, 1 / pixels
  double half_width_;  ///< of the row through the centre, pixels
  double shear_;       ///< how far a row's middle moves for a row upwards, pixels
  double growth_;      ///< of the ratio of neighbouring weights
};

}  // namespace relief::volume_reference
