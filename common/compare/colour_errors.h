// Differences between the colours of two images.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "common/error.h"
#include "common/image/image.h"

namespace relief {

/// The colour of an image, made fit for computing: linear, premultiplied (so over black), finite,
/// not negative.
struct LinearColour {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::array<std::vector<float>, 3> rgb;  ///< one value a pixel each, row-major, top row first
  std::vector<bool> broken;               ///< pixels whose colour was not finite, replaced by 0
};

/// Returns the colour of `image`; values below 0 become 0. Fails, with a clause, if R, G or B is
/// missing.
Result<LinearColour> take_colour(const Image& image);

/// Returns the PSNR in dB of two colours as a display shows them: sRGB-encoded, clamped to [0, 1],
/// peak 1, mean over the three channels. Pixels that are broken in either image count with error 1
/// in each channel. With `mask`, only pixels where it is not 0 count. +infinity without any
/// difference.
[[nodiscard]] double colour_psnr_db(const LinearColour& test, const LinearColour& reference,
                                    const std::vector<std::uint8_t>* mask);

}  // namespace relief
