// How much the density of points varies.
#pragma once

#include <vector>

#include "preprocess/partition/region.h"

namespace relief {

/// Between dense and sparse parts of a set of points.
struct SpacingRange {
  float dense = 0.0F;   ///< a tenth of the points are denser
  float sparse = 0.0F;  ///< a tenth of the area is sparser

  /// Sparse over dense spacing; 1 if no points are spread.
  [[nodiscard]] double ratio() const { return dense > 0.0F ? double{sparse} / dense : 1.0; }
};

/// Returns the range of these local spacings. By points alone a large sparse part would not show,
/// of which the scan has few; by area alone, a small dense one.
[[nodiscard]] SpacingRange spacing_range(std::vector<float> spacings);

/// Returns what `values` say of a region's points, in their order.
[[nodiscard]] std::vector<float> values_of(const std::vector<float>& values, const Region& region);

/// Returns the median of what `values` say of a region's points, of which it has some.
[[nodiscard]] float median_of(const std::vector<float>& values, const Region& region);

}  // namespace relief
