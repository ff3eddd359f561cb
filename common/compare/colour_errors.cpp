#include "common/compare/colour_errors.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "common/compare/statistics.h"
#include "common/image/srgb.h"

namespace relief {

Result<LinearColour> take_colour(const Image& image) {
  LinearColour colour;
  colour.width = image.width;
  colour.height = image.height;
  const std::size_t pixels = std::size_t{image.width} * image.height;
  colour.broken.resize(pixels);
  const char* const names[3] = {"R", "G", "B"};
  for (std::size_t c = 0; c < 3; ++c) {
    const Channel* const channel = image.find(names[c]);
    if (channel == nullptr) return make_error("has no channel {}", names[c]);
    assert(channel->values.size() == pixels && "a channel has a value for each pixel");
    colour.rgb[c] = channel->values;
    for (std::size_t k = 0; k < pixels; ++k) {
      if (!std::isfinite(colour.rgb[c][k])) colour.broken[k] = true;
    }
  }
  for (std::vector<float>& channel : colour.rgb) {
    for (std::size_t k = 0; k < pixels; ++k) {
      channel[k] = colour.broken[k] ? 0.0F : std::max(channel[k], 0.0F);
    }
  }
  return colour;
}

double colour_psnr_db(const LinearColour& test, const LinearColour& reference,
                      const std::vector<std::uint8_t>* mask) {
  const SquaredErrors errors = sum_rows(reference.height, [&](std::uint32_t row) {
    SquaredErrors found;
    const std::size_t first = std::size_t{row} * reference.width;
    for (std::size_t k = first; k < first + reference.width; ++k) {
      if (mask != nullptr && (*mask)[k] == 0) continue;
      const bool broken = test.broken[k] || reference.broken[k];
      for (std::size_t c = 0; c < 3; ++c) {
        const float a = test.rgb[c][k];
        const float b = reference.rgb[c][k];
        if (broken) {
          found.add(1.0);
        } else {
          found.add(a == b ? 0.0 : double{srgb_from_linear(a)} - double{srgb_from_linear(b)});
        }
      }
    }
    return found;
  });
  return psnr_db(errors.rms(), 1.0);
}

}  // namespace relief
