// The pixels that a model covers in two images, and their differences.
#pragma once

#include <cstdint>
#include <vector>

#include "common/error.h"
#include "common/image/image.h"

namespace relief {

/// 1 for covered pixels, 0 for others; row-major, top row first.
struct CoverageMasks {
  std::vector<std::uint8_t> test;
  std::vector<std::uint8_t> reference;
  std::vector<std::uint8_t> both;
};

/// Finds the covered pixels of both images. If an image's alpha is below 1 anywhere, pixels with
/// alpha 0.5 or more are covered, so that antialiased and aliased silhouettes agree to half a
/// pixel. Otherwise (opaque background) pixels with finite depth Z are covered. If only one image
/// has an alpha below 1 and both have Z, Z decides in both. Fails, with a clause, if an image has
/// neither.
Result<CoverageMasks> find_coverage(const Image& test, const Image& reference);

/// Differences in coverage, in pixels.
struct CoverageErrors {
  std::uint64_t covered_reference = 0;
  std::uint64_t covered_both = 0;
  /// Covered only in the reference, where all eight neighbours are covered too (the reference's
  /// silhouette eroded by 3x3). Pixels beyond the image's rim count as covered: a model cut by the
  /// rim has no silhouette there.
  std::uint64_t holes = 0;
  std::uint64_t border_missing = 0;  ///< covered only in the reference, and not a hole
  std::uint64_t border_extra = 0;    ///< covered only in the image under test
};

[[nodiscard]] CoverageErrors count_coverage_errors(const CoverageMasks& masks, std::uint32_t width,
                                                   std::uint32_t height);

}  // namespace relief
