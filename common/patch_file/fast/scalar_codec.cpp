// Maps of scalars in codec 1.
#include <algorithm>

#include "common/io/bytes.h"
#include "common/patch_file/fast/patch_codec.h"
#include "common/patch_file/fast/prediction.h"
#include "common/patch_file/fast/residuals.h"

namespace relief {

std::vector<std::byte> encode_scalar(const Patch& patch, const AttributeMap<std::uint16_t>& map,
                                     ZstdContexts& zstd) {
  const std::vector<std::uint8_t> kept = kept_texels(patch, map.scale);
  const std::vector<std::int32_t> values(map.texels.begin(), map.texels.end());
  std::vector<std::uint16_t> residuals;
  append_predicted({map.width, map.height, kept}, values, predict_median, residuals);
  std::vector<std::byte> bytes;
  append_residuals(bytes, residuals, zstd);
  return bytes;
}

Result<AttributeMap<std::uint16_t>> decode_scalar(std::span<const std::byte> bytes,
                                                  std::uint32_t scale, const Patch& patch,
                                                  ZstdContexts& zstd) {
  ByteReader in(bytes);
  const std::vector<std::uint8_t> kept = kept_texels(patch, scale);
  RELIEF_TRY_ASSIGN(const auto residuals, take_residuals(in, count_marked(kept), zstd));
  RELIEF_TRY(check_end(in));
  std::vector<std::int32_t> values(kept.size(), kNoScalar);
  AttributeMap<std::uint16_t> map;
  shape_map(patch, scale, map);
  undo_predicted(
      {map.width, map.height, kept}, residuals, predict_median,
      [](std::uint16_t bits) { return std::int32_t{bits}; }, values);
  std::ranges::transform(values, map.texels.begin(),
                         [](std::int32_t value) { return static_cast<std::uint16_t>(value); });
  return map;
}

}  // namespace relief
