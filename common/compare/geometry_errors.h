// Differences between normals, depths, grid coordinates and alpha of two images. Errors are clauses
// that give the reason why a quantity could not be measured.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/error.h"
#include "common/image/image.h"

namespace relief {

/// Angles between the normals, over pixels of the mask whose normals are finite and not shorter
/// than 0.001 in both images. The angles do not depend on the lengths.
struct NormalErrors {
  double rms_deg = 0.0;
  double p99_deg = 0.0;  ///< 99th percentile
  double psnr_db = 0.0;  ///< of the components, peak 2; +infinity if equal
};

/// |Z - Z of the reference| / Z of the reference, over pixels of the mask where both are finite and
/// the reference's is above 0.
struct DepthErrors {
  double rms_relative = 0.0;
  double p99_relative = 0.0;      ///< 99 % of the pixels are no farther off
  std::optional<double> psnr_db;  ///< peak: the range of the reference's Z; none if that is 0
};

/// `mask`: compares only pixels where it is not 0; empty: all.
Result<NormalErrors> measure_normals(const Image& test, const Image& reference,
                                     const std::vector<std::uint8_t>* mask);
Result<DepthErrors> measure_depth(const Image& test, const Image& reference,
                                  const std::vector<std::uint8_t>* mask);

/// Returns the PSNR of UV.U and UV.V in dB, over pixels of the mask that show the same patch in
/// both images; peak: the range of the reference's coordinates.
Result<double> measure_uv_psnr_db(const Image& test, const Image& reference,
                                  const std::vector<std::uint8_t>* mask);

/// Returns the PSNR of A in dB over all pixels, clamped to [0, 1], peak 1; NaN counts as 0.
Result<double> measure_alpha_psnr_db(const Image& test, const Image& reference);

}  // namespace relief
