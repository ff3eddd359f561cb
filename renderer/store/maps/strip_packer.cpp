#include "renderer/store/maps/strip_packer.h"

#include <algorithm>
#include <cassert>
#include <functional>
#include <numeric>

namespace relief {
namespace {

/// A horizontal part of the skyline.
struct Ledge {
  std::uint32_t x = 0;
  std::uint32_t y = 0;
  std::uint32_t width = 0;
};

/// How high a rectangle's lower side is that begins where a ledge does.
std::uint32_t height_over(std::span<const Ledge> ledges, std::uint32_t width) {
  const std::uint32_t end = ledges.front().x + width;
  std::uint32_t y = 0;
  for (const Ledge& ledge : ledges) {
    if (ledge.x >= end) break;
    y = std::max(y, ledge.y);
  }
  return y;
}

/// Raises the skyline to `roof`, which begins where ledge `first` does.
void raise(std::vector<Ledge>& ledges, std::size_t first, const Ledge& roof) {
  const std::uint32_t end = roof.x + roof.width;
  std::size_t last = first;
  while (last < ledges.size() && ledges[last].x + ledges[last].width <= end) ++last;
  if (last < ledges.size() && ledges[last].x < end) {
    ledges[last].width -= end - ledges[last].x;
    ledges[last].x = end;
  }
  const auto begin = ledges.begin();
  ledges.erase(begin + static_cast<std::ptrdiff_t>(first),
               begin + static_cast<std::ptrdiff_t>(last));
  ledges.insert(ledges.begin() + static_cast<std::ptrdiff_t>(first), roof);
}

}  // namespace

PackedStrip pack_strip(std::span<const glm::uvec2> sizes, std::uint32_t width) {
  std::vector<std::size_t> order(sizes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::greater(), [&sizes](std::size_t r) { return sizes[r].y; });
  PackedStrip packed{std::vector<glm::uvec2>(sizes.size()), 0};
  std::vector<Ledge> ledges{{0, 0, width}};
  for (const std::size_t r : order) {
    const glm::uvec2 size = sizes[r];
    assert(size.x > 0 && size.x <= width && "the strip holds each");
    std::size_t best = 0;
    std::uint32_t lowest = height_over(ledges, size.x);
    for (std::size_t k = 1; k < ledges.size() && ledges[k].x + size.x <= width; ++k) {
      const std::uint32_t y = height_over(std::span(ledges).subspan(k), size.x);
      if (y < lowest) {
        lowest = y;
        best = k;
      }
    }
    const std::uint32_t x = ledges[best].x;
    packed.corners[r] = {x, lowest};
    packed.height = std::max(packed.height, lowest + size.y);
    raise(ledges, best, {x, lowest + size.y, size.x});
  }
  return packed;
}

}  // namespace relief
