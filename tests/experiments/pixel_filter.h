// From many samples a pixel to pixels.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "common/image/image.h"
#include "tests/experiments/image_error.h"

namespace relief::experiment {

/// What an image should be, linear light, and the share of each pixel that the subject covers
/// under the pixel's whole filter.
struct Truth {
  Image image;
  std::vector<double> coverage;
  /// Pixels that the subject covers with all of the filter.
  [[nodiscard]] Mask covered() const;
};

/// The same samples through two low-pass filters: the Gaussian of unit variance in pixels that EWA
/// takes ([Zwicker 2001], section 3.3), cut at four, and the mean over each pixel, which is what a
/// ray tracer gives.
struct Truths {
  Truth gaussian;
  Truth box;
};

/// Linear RGB, premultiplied by the coverage in A, at a place of the image: pixels from its upper
/// left corner. Called from several threads, also for places up to four pixels beside the image.
using SampleAt = std::function<glm::dvec4(glm::dvec2 place)>;

/// A square image of `side` pixels, each of per_side^2 samples on a regular grid. Holds
/// 64 * side * (side + 8) * per_side bytes while it works.
[[nodiscard]] Truths filter_samples(std::uint32_t side, std::uint32_t per_side,
                                    const SampleAt& sample);

}  // namespace relief::experiment
