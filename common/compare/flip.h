// FLIP, the difference between two pictures that a person sees who flips between them.
//   LDR-FLIP: Andersson, Nilsson, Akenine-Moller, Oskarsson, Astrom, Fairchild, "FLIP: A Difference
//     Evaluator for Alternating Images", HPG 2020.
//   HDR-FLIP: Andersson, Nilsson, Shirley, Akenine-Moller, "Visualizing Errors in Rendered High
//     Dynamic Range Images", Eurographics 2021.
#pragma once

#include <cstdint>
#include <vector>

#include "common/compare/colour_errors.h"
#include "common/error.h"
#include "common/progress.h"

namespace relief {

/// Ldr: colours are what a display shows, clamped to [0, 1]. Hdr: colours are light; the largest
/// error over the exposures at which the reference shows something.
enum class FlipRange : std::uint8_t { Ldr, Hdr };

/// The papers' observer: 0.7 m from a display 0.7 m wide with 3840 pixels, about 67.02.
inline constexpr double kFlipPixelsPerDegree = 3840.0 * 3.14159265358979323846 / 180.0;

struct FlipOptions {
  FlipRange range = FlipRange::Hdr;
  double pixels_per_degree = kFlipPixelsPerDegree;  ///< 1 to 1000; the filters grow with it
};

/// Factors of two by which light is multiplied before tone mapping; start <= stop.
struct Exposures {
  double start = 0.0;
  double stop = 0.0;
  int count = 1;  ///< evenly from start to stop, both included
};

struct Flip {
  std::vector<float> map;  ///< a value in [0, 1] for each pixel, row-major, top row first
  double mean = 0.0;
  Exposures exposures;  ///< one, at 0, for Ldr
};

/// The FLIP map of two pictures of one size. A pixel that is broken in either has 1. Fails only
/// when `progress` is cancelled.
Result<Flip> measure_flip(const LinearColour& test, const LinearColour& reference,
                          const FlipOptions& options, Progress& progress);

/// The exposures of HDR-FLIP (2021, section 3.3): at the first the reference's brightest pixel is
/// tone-mapped to 0.85, at the last its median one; one exposure a stop, at least two. As in the
/// published tool the median is taken for 1.2e-7 if it is less, as with a model on black.
[[nodiscard]] Exposures find_exposures(const LinearColour& reference);

}  // namespace relief
