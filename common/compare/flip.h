// FLIP: the difference that a person sees when flipping between two images.
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

/// Ldr: colours are display values, clamped to [0, 1]. Hdr: colours are radiance; the error is the
/// largest over the exposures that suit the reference.
enum class FlipRange : std::uint8_t { Ldr, Hdr };

/// The observer of the papers: 0.7 m from a display 0.7 m wide with 3840 pixels, about 67.02.
inline constexpr double kFlipPixelsPerDegree = 3840.0 * 3.14159265358979323846 / 180.0;

struct FlipOptions {
  FlipRange range = FlipRange::Hdr;
  double pixels_per_degree = kFlipPixelsPerDegree;  ///< 1 to 1000; the filters grow with it
};

/// Factors of two by which light is multiplied before tone mapping; start <= stop.
struct Exposures {
  double start = 0.0;
  double stop = 0.0;
  int count = 1;  ///< evenly spaced from start to stop, inclusive
};

struct Flip {
  std::vector<float> map;  ///< a value in [0, 1] for each pixel, row-major, top row first
  double mean = 0.0;
  Exposures exposures;  ///< one, at 0, for Ldr
};

/// Returns the FLIP map of two images of one size. Pixels that are broken in either image have 1.
/// Fails only if `progress` is cancelled.
Result<Flip> measure_flip(const LinearColour& test, const LinearColour& reference,
                          const FlipOptions& options, Progress& progress);

/// Returns the exposures of HDR-FLIP (2021, section 3.3): the first maps the reference's brightest
/// pixel to 0.85, the last its median pixel; one exposure a stop, at least two. As in the published
/// tool, the median is at least 1.2e-7, which matters for a model on black.
[[nodiscard]] Exposures find_exposures(const LinearColour& reference);

}  // namespace relief
