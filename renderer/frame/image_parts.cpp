#include "renderer/frame/image_parts.h"

#include <algorithm>
#include <cassert>

namespace relief {
namespace {

constexpr std::uint64_t ceil_of(std::uint64_t a, std::uint64_t b) {
  return (a + b - 1) / b;
}

}  // namespace

std::uint32_t samples_a_side(int samples) {
  assert(samples >= 1 && "a pixel has a sample");
  std::uint32_t side = 1;
  while (side * side < static_cast<std::uint32_t>(samples)) ++side;
  return side;
}

std::vector<Raster> parts_of(std::uint32_t width, std::uint32_t height, std::uint32_t side,
                             std::uint32_t largest) {
  assert(width > 0 && height > 0 && side > 0 && largest >= side && "a pixel fits into a target");
  // Whole rows as long as they fit: what is drawn twice is patches that two parts show.
  const std::uint64_t most_pixels =
      std::max<std::uint64_t>(1, kMostPartSamples / (std::uint64_t{side} * side));
  const std::uint64_t most_side = largest / side;
  const std::uint64_t columns = ceil_of(width, std::min(most_side, most_pixels));
  const std::uint64_t part_width = ceil_of(width, columns);
  const std::uint64_t rows =
      ceil_of(height, std::min(most_side, std::max<std::uint64_t>(1, most_pixels / part_width)));
  std::vector<Raster> parts;
  parts.reserve(columns * rows);
  for (std::uint64_t row = 0; row < rows; ++row) {
    const auto bottom = static_cast<std::uint32_t>(height * row / rows);
    const auto top = static_cast<std::uint32_t>(height * (row + 1) / rows);
    for (std::uint64_t column = 0; column < columns; ++column) {
      const auto left = static_cast<std::uint32_t>(width * column / columns);
      const auto right = static_cast<std::uint32_t>(width * (column + 1) / columns);
      parts.push_back({left, bottom, right - left, top - bottom, side});
    }
  }
  return parts;
}

}  // namespace relief
