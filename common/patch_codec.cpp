#include "common/patch_codec.h"

#include <algorithm>
#include <cassert>

#include "common/bytes.h"
#include "common/mask_codec.h"
#include "common/prediction.h"
#include "common/residuals.h"

namespace relief {

std::vector<std::uint8_t> sample_mask(const Patch& patch) {
  std::vector<std::uint8_t> mask(patch.heights.size());
  std::transform(patch.heights.begin(), patch.heights.end(), mask.begin(),
                 [](std::int32_t h) { return static_cast<std::uint8_t>(h != kHole ? 1 : 0); });
  return mask;
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
  const auto mask = take_mask(in, patch.width, patch.height, zstd);
  if (!mask) return mask.error();
  const auto marked = static_cast<std::size_t>(std::count(mask->begin(), mask->end(), 1));
  if (marked != samples) {
    return make_error("the mask has {} samples where the index says {}", marked, samples);
  }
  const auto residuals = take_residuals(in, marked, zstd);
  if (!residuals) return residuals.error();
  if (Status end = check_end(in); !end) return end;

  patch.heights.assign(mask->size(), kHole);
  undo_plane({patch.width, patch.height, *mask}, *residuals, patch.heights);
  if (std::any_of(patch.heights.begin(), patch.heights.end(),
                  [](std::int32_t h) { return h > kMaxHeightRange; })) {
    return make_error("a height lies above {}", kMaxHeightRange);
  }
  return {};
}

}  // namespace relief
