// Which pixels a model covers in two pictures, and where the pictures differ in that.
#pragma once

#include <cstdint>
#include <vector>

#include "common/error.h"
#include "common/image/image.h"

namespace relief {

/// 1 where a picture is covered, 0 elsewhere; row-major, top row first.
struct CoverageMasks {
  std::vector<std::uint8_t> test;
  std::vector<std::uint8_t> reference;
  std::vector<std::uint8_t> both;
};

/// Finds what is covered. A picture's alpha tells if it is below 1 anywhere: covered is what has
/// 0.5 or more of it, so that an antialiased silhouette and one that is not agree to half a pixel.
/// Else (opaque background) the depth Z tells: covered is where it is finite. If alpha does not
/// tell in both and both have Z, Z is taken for both. Fails, with a clause, if a picture has
/// neither.
Result<CoverageMasks> find_coverage(const Image& test, const Image& reference);

/// Where coverage differs, in pixels.
struct CoverageErrors {
  std::uint64_t covered_reference = 0;
  std::uint64_t covered_both = 0;
  /// Covered in the reference alone, together with all eight neighbours there (the reference's
  /// silhouette eroded by 3x3). What lies beyond the picture's rim counts as covered: a model that
  /// the rim cuts has no silhouette there.
  std::uint64_t holes = 0;
  std::uint64_t border_missing = 0;  ///< covered in the reference alone, and no hole
  std::uint64_t border_extra = 0;    ///< covered in the picture under test alone
};

[[nodiscard]] CoverageErrors count_coverage_errors(const CoverageMasks& masks, std::uint32_t width,
                                                   std::uint32_t height);

}  // namespace relief
