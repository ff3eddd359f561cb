#include "common/compact/compact_mask.h"

#include <array>

namespace relief {
namespace {

#include "common/compact/compact_mask_chances.inc"

/// Calls `code(chance)` for each node in scan order; `chance` of 4096 is that it is a sample, and
/// what is returned is whether it is one. What decides: two nodes to the west, five of the row
/// above and the one above that; outside of the grid there are no samples.
template <class Code>
void visit_mask(std::size_t width, std::size_t height, const Code& code) {
  std::vector<std::uint8_t> above(width + 4, 0);
  std::vector<std::uint8_t> row(width + 4, 0);
  std::vector<std::uint8_t> second(width + 4, 0);
  for (std::size_t j = 0; j < height; ++j) {
    // Bits: 0, 1 west and west of it; 2 to 6 the row above from east to west; 7 two rows above.
    unsigned west = 0;
    unsigned north = above[2] << 1U | above[3];
    for (std::size_t i = 0; i < width; ++i) {
      north = (north << 1U | above[i + 4]) & 31U;
      const unsigned context = west | north << 2U | unsigned{second[i + 2]} << 7U;
      const bool is_sample = code(kSampleChances[context]);
      row[i + 2] = is_sample ? 1 : 0;
      west = (west << 1U | row[i + 2]) & 3U;
    }
    second.swap(above);
    above.swap(row);
  }
}

Interval interval_of(std::uint16_t chance, bool is_sample) {
  return is_sample ? Interval{0, chance}
                   : Interval{chance, static_cast<std::uint16_t>(kProbabilityOne - chance)};
}

}  // namespace

void put_mask(RansEncoder& out, std::span<const std::uint8_t> mask, std::size_t width) {
  auto node = mask.begin();
  visit_mask(width, mask.size() / width, [&](std::uint16_t chance) {
    const bool is_sample = *node++ != 0;
    out.put(interval_of(chance, is_sample));
    return is_sample;
  });
}

std::vector<std::uint8_t> take_mask(RansDecoder& in, std::size_t width, std::size_t height) {
  std::vector<std::uint8_t> mask(width * height);
  auto node = mask.begin();
  visit_mask(width, height, [&](std::uint16_t chance) {
    const bool is_sample = in.peek() < chance;
    in.advance(interval_of(chance, is_sample));
    *node++ = is_sample ? 1 : 0;
    return is_sample;
  });
  return mask;
}

}  // namespace relief
