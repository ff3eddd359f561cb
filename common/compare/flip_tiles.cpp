#include "common/compare/flip_tiles.h"

#include <algorithm>

namespace relief {
namespace {

/// Filtering repeats the pixels about a tile, at 67 pixels per degree 20 rows and columns. Smaller
/// tiles would repeat more. Larger ones would leave the cache: an image's seven filtered planes of
/// a tile have 0.6 MB.
constexpr std::uint32_t kTileRows = 64;
constexpr std::uint32_t kTileColumns = 256;

/// Pixels of one axis, `end` excluded.
struct Range {
  std::size_t begin = 0;
  std::size_t end = 0;
};

struct Box {
  Range x, y;
};

/// Returns `range` with `reach` more at both ends, as far as it is within `limit`.
Range widened(const Range& range, std::size_t reach, const Range& limit) {
  return {range.begin > limit.begin + reach ? range.begin - reach : limit.begin,
          std::min(range.end + reach, limit.end)};
}

Box widened(const Box& box, std::size_t reach, const Box& limit) {
  return {widened(box.x, reach, limit.x), widened(box.y, reach, limit.y)};
}

std::vector<std::uint8_t> find_differences(const LinearColour& a, const LinearColour& b) {
  std::vector<std::uint8_t> differ(a.rgb[0].size());
  for (std::size_t channel = 0; channel < 3; ++channel) {
    for (std::size_t k = 0; k < differ.size(); ++k) {
      differ[k] |= static_cast<std::uint8_t>(a.rgb[channel][k] != b.rgb[channel][k]);
    }
  }
  return differ;
}

/// Returns the smallest box about the differences within `box`; one of no rows if there are none.
Box shrunk_to_differences(const std::vector<std::uint8_t>& differ, std::size_t width,
                          const Box& box) {
  Box found{{box.x.end, box.x.begin}, {box.y.begin, box.y.begin}};
  for (std::size_t y = box.y.begin; y < box.y.end; ++y) {
    const std::uint8_t* const row = differ.data() + y * width;
    const auto* const first = std::find(row + box.x.begin, row + box.x.end, 1);
    if (first == row + box.x.end) continue;
    const auto* last = row + box.x.end;
    while (last[-1] == 0) --last;
    found.x.begin = std::min(found.x.begin, static_cast<std::size_t>(first - row));
    found.x.end = std::max(found.x.end, static_cast<std::size_t>(last - row));
    if (found.y.begin == found.y.end) found.y.begin = y;
    found.y.end = y + 1;
  }
  return found;
}

}  // namespace

std::vector<FlipTile> find_differing_tiles(const LinearColour& test, const LinearColour& reference,
                                           std::size_t reach) {
  const std::vector<std::uint8_t> differ = find_differences(test, reference);
  const Box image{{0, reference.width}, {0, reference.height}};
  std::vector<FlipTile> tiles;
  for (std::size_t y = 0; y < image.y.end; y += kTileRows) {
    for (std::size_t x = 0; x < image.x.end; x += kTileColumns) {
      const Box tile{{x, std::min(x + kTileColumns, image.x.end)},
                     {y, std::min(y + kTileRows, image.y.end)}};
      const Box found = shrunk_to_differences(differ, reference.width, widened(tile, reach, image));
      if (found.y.begin == found.y.end) continue;
      const Box seen = widened(found, reach, tile);
      tiles.push_back({static_cast<std::uint32_t>(seen.x.begin),
                       static_cast<std::uint32_t>(seen.y.begin),
                       static_cast<std::uint32_t>(seen.x.end - seen.x.begin),
                       static_cast<std::uint32_t>(seen.y.end - seen.y.begin)});
    }
  }
  return tiles;
}

}  // namespace relief
