#include "common/patch_file/fast/mask_codec.h"

#include <algorithm>

#include "common/io/varint.h"
#include "common/patch_file/fast/residuals.h"

namespace relief {
void append_mask(std::vector<std::byte>& out, std::span<const std::uint8_t> mask, std::size_t width,
                 ZstdContexts& zstd) {
  std::vector<std::uint8_t> runs;
  std::uint8_t state = 0;
  std::size_t start = 0;
  for (std::size_t k = 0; k < mask.size(); ++k) {
    const auto change = static_cast<std::uint8_t>(mask[k] ^ (k >= width ? mask[k - width] : 0));
    if (change == state) continue;
    append_varint(runs, k - start);
    state = change;
    start = k;
  }
  append_sized_stream(out, runs, zstd);
}

Result<std::vector<std::uint8_t>> take_mask(ByteReader& in, std::size_t width, std::size_t height,
                                            ZstdContexts& zstd) {
  const std::size_t nodes = width * height;
  // Each run but the first is at least one node long and one of n nodes takes at most n bytes.
  const auto runs = take_sized_stream(in, nodes + 1, zstd);
  if (!runs) return runs.error();

  std::vector<std::uint8_t> mask(nodes, 0);
  std::uint8_t state = 0;
  std::size_t at = 0;
  for (auto byte = runs->begin(); byte != runs->end();) {
    std::uint64_t length = 0;
    for (unsigned shift = 0;; shift += 7) {
      // Five bytes hold any run on the largest grid.
      if (byte == runs->end() || shift > 28) return make_error("a run of the mask is damaged");
      length |= std::uint64_t{*byte & 0x7FU} << shift;
      if ((*byte++ & 0x80U) == 0) break;
    }
    if (length > nodes - at) return make_error("a run of the mask leaves the grid");
    std::fill_n(mask.begin() + static_cast<std::ptrdiff_t>(at), length, state);
    at += length;
    state ^= 1U;
  }
  std::fill(mask.begin() + static_cast<std::ptrdiff_t>(at), mask.end(), state);
  for (std::size_t k = width; k < nodes; k += width) {
    const std::uint8_t* const north = &mask[k - width];
    std::uint8_t* __restrict row = &mask[k];
    for (std::size_t i = 0; i < width; ++i) row[i] ^= north[i];
  }
  return mask;
}

}  // namespace relief
