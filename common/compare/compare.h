// Two pictures of one scene: how far the one is from the other.
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

/// Everything that was measured. A Result without value says, as a clause, why a quantity could not
/// be measured. No number is NaN; a PSNR is +infinity where there is no difference.
struct Comparison {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  /// The same channels with the same values, to the last bit.
  bool identical = false;
  /// Pixels that hold a value that is none: NaN in any channel, or an infinity in any but Z.
  std::uint64_t non_finite = 0;
  std::uint64_t non_finite_reference = 0;
  double psnr_db = 0.0;            ///< colour, see colour_psnr_db, over all pixels
  Result<double> psnr_covered_db;  ///< the same over pixels that both pictures cover
  Flip flip;
  Result<CoverageErrors> coverage;
  Result<NormalErrors> normal;  ///< these over pixels that both cover, all where that is unknown
  Result<DepthErrors> depth;
  Result<double> psnr_uv_db;
  Result<double> psnr_alpha_db;
};

/// Compares the picture under test with the reference. Channels as in common/image.h; which of them
/// the pictures have decides what can be measured. Fails, with a sentence that calls the pictures
/// "the picture under test" and "the reference", if their sizes differ or one has no colour, or
/// when `progress` is cancelled.
Result<Comparison> compare_images(const Image& test, const Image& reference,
                                  const FlipOptions& options, Progress& progress);

}  // namespace relief
