#include "viewer/inspecting/difference_map.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "common/compare/colour_errors.h"
#include "common/image/srgb.h"
#include "viewer/inspecting/inspection_colours.h"

namespace relief {
namespace {

void expose(LinearColour& colour, double stops) {
  const auto factor = static_cast<float>(std::exp2(stops));
  for (std::vector<float>& channel : colour.rgb) {
    for (float& value : channel) value *= factor;
  }
}

}  // namespace

Result<DifferenceMap> map_difference(const Image& shown, const Image& truth, double exposure) {
  if (shown.width != truth.width || shown.height != truth.height)
    return make_error("has {}x{} pixels, and the truth {}x{}", shown.width, shown.height,
                      truth.width, truth.height);
  RELIEF_TRY_ASSIGN(LinearColour a, take_colour(shown));
  RELIEF_TRY_ASSIGN(LinearColour b, take_colour(truth));
  expose(a, exposure);
  expose(b, exposure);
  std::array<glm::u8vec4, 256> colours;
  for (std::size_t k = 0; k < colours.size(); ++k)
    colours[k] = {colour_at(kDifferenceMap, double(k) / double(colours.size() - 1)), 255};
  DifferenceMap map{shown.width, shown.height, {}, colour_psnr_db(a, b, nullptr)};
  map.pixels.resize(std::size_t{map.width} * map.height);
  for (std::size_t y = 0; y < map.height; ++y) {
    for (std::size_t x = 0; x < map.width; ++x) {
      const std::size_t from = (map.height - 1 - y) * map.width + x;
      float steps = 0.0F;
      for (std::size_t c = 0; c < 3; ++c)
        steps = std::max(steps, 255.0F * std::abs(srgb_from_linear(a.rgb[c][from]) -
                                                  srgb_from_linear(b.rgb[c][from])));
      const double share = std::min(double{steps} / kMostDifference, 1.0);
      map.pixels[y * map.width + x] = colours[static_cast<std::size_t>(std::lround(255.0 * share))];
    }
  }
  return map;
}

Image join_at(const Image& left, const Image& right, double share) {
  assert(left.width == right.width && left.channels.size() == right.channels.size());
  Image joined = left;
  const auto cut = static_cast<std::size_t>(std::lround(std::clamp(share, 0.0, 1.0) * left.width));
  for (std::size_t c = 0; c < joined.channels.size(); ++c) {
    for (std::size_t y = 0; y < joined.height; ++y) {
      const auto row = static_cast<std::ptrdiff_t>(y * joined.width);
      std::copy(right.channels[c].values.begin() + row + static_cast<std::ptrdiff_t>(cut),
                right.channels[c].values.begin() + row + joined.width,
                joined.channels[c].values.begin() + row + static_cast<std::ptrdiff_t>(cut));
    }
  }
  return joined;
}

}  // namespace relief
