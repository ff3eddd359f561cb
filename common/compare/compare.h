// Compares two images of one scene.
#pragma once

#include <cstdint>
#include <optional>

#include "common/compare/coverage.h"
#include "common/compare/flip.h"
#include "common/compare/geometry_errors.h"
#include "common/error.h"
#include "common/image/image.h"
#include "common/progress.h"

namespace relief {

/// All measured quantities. A Result without a value holds the reason, a clause. No number is NaN;
/// a PSNR is +infinity if there is no difference.
struct Comparison {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  /// Channels and values are equal to the last bit.
  bool identical = false;
  /// Pixels with NaN in any channel, or an infinity in any channel but Z.
  std::uint64_t non_finite = 0;
  std::uint64_t non_finite_reference = 0;
  double psnr_db = 0.0;            ///< colour, see colour_psnr_db, over all pixels
  Result<double> psnr_covered_db;  ///< colour_psnr_db over pixels that both images cover
  Flip flip;
  Result<CoverageErrors> coverage;
  Result<NormalErrors>
      normal;  ///< over pixels that both images cover; over all if coverage is unknown
  Result<DepthErrors> depth;
  Result<double> psnr_uv_db;
  Result<double> psnr_alpha_db;
};

/// Compares the image under test with the reference. Channels as in common/image/image.h; the
/// channels that both images have decide what can be measured. Fails, with a sentence that calls
/// the images "the image under test" and "the reference", if their sizes differ or one has no
/// colour, or when `progress` is cancelled.
Result<Comparison> compare_images(const Image& test, const Image& reference,
                                  const FlipOptions& options, Progress& progress);

}  // namespace relief
