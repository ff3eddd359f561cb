#include "renderer/store/maps/atlas.h"

#include <algorithm>
#include <numeric>

namespace relief {
namespace {

/// Layers need not be larger than this unless a map is: 16 MiB at four bytes a texel.
constexpr std::uint32_t kUsualSide = 2048;
/// Maps with mip levels are fewer and larger, and one layer ends with its last shelf: Spot 45 MB in
/// two layers of the usual side, of which the second is nearly empty.
constexpr std::uint32_t kUsualSideOfBlocks = 8192;

std::uint32_t layer_side(const std::vector<glm::uvec2>& sizes, std::uint32_t usual_side) {
  std::uint64_t area = 0;
  std::uint32_t side = 1;
  for (const glm::uvec2 size : sizes) {
    area += std::uint64_t{size.x} * size.y;
    side = std::max({side, size.x, size.y});
  }
  // About a tenth of a layer is lost to the shelves.
  while (side < usual_side && std::uint64_t{side} * side < area + area / 8) {
    side = std::min(side + side / 4 + 1, usual_side);
  }
  return side;
}

}  // namespace

std::optional<Atlas> pack_atlas(const std::vector<glm::uvec2>& given, std::uint32_t largest_side,
                                std::uint32_t most_layers, std::uint32_t block) {
  std::vector<glm::uvec2> sizes;
  sizes.reserve(given.size());
  for (const glm::uvec2 size : given) sizes.push_back(whole_blocks(size, block));
  const std::uint32_t usual = std::min(block > 1 ? kUsualSideOfBlocks : kUsualSide, largest_side);
  const std::uint32_t side = whole_blocks(glm::uvec2(layer_side(sizes, usual)), block).x;
  if (side > largest_side) return std::nullopt;
  std::vector<std::size_t> order(sizes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&sizes](std::size_t a, std::size_t b) { return sizes[a].y > sizes[b].y; });

  Atlas atlas;
  atlas.spots.resize(sizes.size());
  AtlasSpot next;  // on the current shelf
  std::uint32_t shelf_top = 0;
  std::uint32_t used_rows = 1;
  for (const std::size_t m : order) {
    const glm::uvec2 size = sizes[m];
    if (next.x + size.x > side) {
      next.x = 0;
      next.y = shelf_top;
    }
    if (next.y + size.y > side) {
      next = {0, 0, next.layer + 1};
      shelf_top = 0;
    }
    atlas.spots[m] = next;
    next.x += size.x;
    shelf_top = std::max(shelf_top, next.y + size.y);
    used_rows = std::max(used_rows, shelf_top);
  }
  atlas.layers = next.layer + 1;
  atlas.size = whole_blocks({side, used_rows}, block);
  if (atlas.layers > most_layers) return std::nullopt;
  return atlas;
}

}  // namespace relief
