// How far an image is from what it should be, over some of its pixels.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/error.h"
#include "common/image/image.h"

namespace relief::experiment {

/// Pixels that count are not 0; row-major, top row first.
using Mask = std::vector<std::uint8_t>;

struct ImageError {
  double psnr_db = 0.0;    ///< of sRGB values clamped to [0, 1]
  double flip_mean = 0.0;  ///< of LDR-FLIP at 67 pixels per degree
};

/// What `relief compare --flip ldr` would say of the pixels of the mask alone: both means are over
/// them, and beside them the truth is put into the image. Fails if the mask is empty or an image
/// has no colour.
Result<ImageError> measure_error(const Image& image, const Image& truth, const Mask& mask);

/// As a cell of a table: "31.4 / 0.051", dB / FLIP; a dash where nothing was measured.
[[nodiscard]] std::string as_cell(const Result<ImageError>& error);

}  // namespace relief::experiment
