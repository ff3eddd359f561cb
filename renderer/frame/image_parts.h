// How a large image is cut into parts that one target can hold.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/view/view.h"

namespace relief {

/// Texels of a target, at most: 200 MB with its depth buffer, 900 MB with the sums of `multipass`.
/// Between two parts the user can interrupt.
inline constexpr std::uint64_t kMaxPartSamples = std::uint64_t{1} << 24U;

/// Samples along a pixel's side for at least `samples` of them in a pixel, at least 1.
[[nodiscard]] std::uint32_t samples_a_side(int samples);

/// The parts of an image with `side` samples along each side of a pixel, row by row from the lower
/// left, each of at most `largest` samples along a side and, unless it is one pixel, of at most
/// kMaxPartSamples. They are as alike in size as whole pixels allow. `largest` is not below
/// `side`.
[[nodiscard]] std::vector<Raster> parts_of(std::uint32_t width, std::uint32_t height,
                                           std::uint32_t side, std::uint32_t largest);

}  // namespace relief
