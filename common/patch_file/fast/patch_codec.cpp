#include "common/patch_file/fast/patch_codec.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "common/io/bytes.h"
#include "common/patch_file/fast/mask_codec.h"
#include "common/patch_file/fast/plane_rows.h"
#include "common/patch_file/fast/prediction.h"
#include "common/patch_file/fast/residuals.h"

namespace relief {

std::vector<std::uint8_t> sample_mask(const Patch& patch) {
  std::vector<std::uint8_t> mask(patch.heights.size());
  std::transform(patch.heights.begin(), patch.heights.end(), mask.begin(),
                 [](std::int32_t h) { return static_cast<std::uint8_t>(h != kHole ? 1 : 0); });
  return mask;
}

std::uint32_t count_marked(std::span<const std::uint8_t> mask) {
  // In bytes, as long as they hold the sums: SIMD adds sixteen at a time.
  constexpr std::size_t kLanes = 16;
  std::uint32_t sum = 0;
  while (mask.size() >= kLanes) {
    const std::size_t blocks = std::min<std::size_t>(mask.size() / kLanes, 255);
    std::array<std::uint8_t, kLanes> sums{};
    for (std::size_t b = 0; b < blocks; ++b) {
      for (std::size_t l = 0; l < kLanes; ++l)
        sums[l] = static_cast<std::uint8_t>(sums[l] + mask[b * kLanes + l]);
    }
    for (const std::uint8_t s : sums) sum += s;
    mask = mask.subspan(blocks * kLanes);
  }
  for (const std::uint8_t m : mask) sum += m;
  return sum;
}

std::vector<std::uint8_t> kept_texels(const Patch& patch, std::uint32_t scale) {
  assert(scale > 0 && "a map has a texel a cell or more");
  std::vector<std::uint8_t> mask = sample_mask(patch);
  if (scale == 1) return mask;
  const std::size_t width = std::size_t{scale} * (patch.width - 1) + 1;
  const std::size_t height = std::size_t{scale} * (patch.height - 1) + 1;
  std::vector<std::uint8_t> kept(width * height);
  for (std::size_t b = 0; b < height; ++b) {
    const std::size_t north = b / scale * patch.width;
    const std::size_t south = (b + scale - 1) / scale * patch.width;
    for (std::size_t a = 0; a < width; ++a) {
      const std::size_t west = a / scale;
      const std::size_t east = (a + scale - 1) / scale;
      kept[b * width + a] =
          mask[south + west] | mask[south + east] | mask[north + west] | mask[north + east];
    }
  }
  return kept;
}

std::vector<std::byte> encode_heights(const Patch& patch, ZstdContexts& zstd) {
  const std::vector<std::uint8_t> mask = sample_mask(patch);
  std::vector<std::byte> bytes;
  append_mask(bytes, mask, patch.width, zstd);
  std::vector<std::uint16_t> residuals;
  residuals.reserve(mask.size());
  append_predicted({patch.width, patch.height, mask}, patch.heights, predict_plane, residuals);
  append_residuals(bytes, residuals, zstd);
  return bytes;
}

Status decode_heights(std::span<const std::byte> bytes, std::uint32_t samples, Patch& patch,
                      ZstdContexts& zstd) {
  ByteReader in(bytes);
  RELIEF_TRY_ASSIGN(const auto mask, take_mask(in, patch.width, patch.height, zstd));
  const std::uint32_t marked = count_marked(mask);
  if (marked != samples) {
    return make_error("the mask has {} samples, but the index states {}", marked, samples);
  }
  RELIEF_TRY_ASSIGN(const auto differences, take_differences(in, marked, kDifferencePadding, zstd));
  RELIEF_TRY(check_end(in));

  patch.heights.resize(mask.size());
  static_assert(kMaxHeightRange == 65534);
  if (undo_plane({patch.width, patch.height, mask}, differences, kHole, patch.heights)) {
    return make_error("a height lies above {}", kMaxHeightRange);
  }
  return {};
}

}  // namespace relief
