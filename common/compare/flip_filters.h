// The filters of FLIP, all separable.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace relief {

/// Weights for the offsets -radius to radius.
using Taps = std::vector<float>;

/// Filters for the resolution of the eye (2020, section 4.1.1: contrast sensitivity functions as
/// Gaussians) and for edges and points (section 4.2.1: derivatives of a Gaussian). Each is applied
/// along x and then along y.
struct FlipFilters {
  std::size_t contrast_radius = 0;
  Taps luminance;         ///< of Y, sum 1
  Taps red_green;         ///< of Cx, sum 1
  Taps blue_yellow;       ///< of Cz, a sum of two Gaussians: this one twice, plus
  Taps blue_yellow_wide;  ///< this one twice; their squared sums add up to 1

  std::size_t feature_radius = 0;
  Taps smooth;  ///< Gaussian, sum 1
  Taps edge;    ///< first derivative; positive and negative weights sum to 1 and -1
  Taps point;   ///< second derivative; likewise
};

/// Returns the radius of the widest filter.
[[nodiscard]] inline std::size_t reach_of(const FlipFilters& filters) {
  return std::max(filters.contrast_radius, filters.feature_radius);
}

/// `pixels_per_degree`: 1 or more.
[[nodiscard]] FlipFilters make_flip_filters(double pixels_per_degree);

/// out[x] = sum of taps[i] * in[x + i] for x from 0 to count - 1: `in` starts a radius before the
/// row and has count + 2 radius values.
void filter_along_row(const float* in, const Taps& taps, std::size_t count, float* out);

/// out[x] = sum of taps[i] * first[i * stride + x]: rows lie a stride apart, the first of them a
/// radius above the row that comes out.
void filter_across_rows(const float* first, std::size_t stride, const Taps& taps, std::size_t count,
                        float* out);

}  // namespace relief
