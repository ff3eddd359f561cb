// Normal maps in codec 1.
#include <algorithm>

#include "common/io/bytes.h"
#include "common/patch_file/continuation.h"
#include "common/patch_file/fast/patch_codec.h"
#include "common/patch_file/fast/prediction.h"
#include "common/patch_file/fast/residuals.h"
#include "common/patch_file/normals_of_heights.h"

namespace relief {
namespace {

/// The base of coded normals. The encoder chooses the shorter result: scanned surfaces are rough,
/// and their heights then predict better than neighbouring normals (on the Stanford Dragon 11.2
/// against 12.7 bits a normal); smooth surfaces and maps finer than the grid continue as planes.
enum class NormalPredictor : std::uint8_t { Plane = 0, Heights = 1 };

std::int32_t rounded_quotient(std::int32_t value) {
  constexpr std::int32_t kHalf = kNormalStep / 2;
  return value >= 0 ? (value + kHalf) / kNormalStep : -((kHalf - value) / kNormalStep);
}

std::vector<std::byte> encode(const Patch& patch, const KeptGrid& grid, NormalPredictor predictor,
                              ZstdContexts& zstd) {
  const auto& texels = patch.normals.texels;
  std::vector<glm::i16vec2> bases(texels.size(), glm::i16vec2(0));
  if (predictor == NormalPredictor::Heights) bases = normals_of_heights(patch, kNormalStep);
  std::vector<std::uint16_t> residuals;
  residuals.reserve(2 * texels.size());
  std::vector<std::int32_t> values(texels.size());
  for (glm::length_t component = 0; component < 2; ++component) {
    for (std::size_t k = 0; k < texels.size(); ++k) {
      values[k] = rounded_quotient(texels[k][component]) - bases[k][component];
    }
    append_predicted(grid, values,
                     predictor == NormalPredictor::Heights ? predict_mean : predict_plane,
                     residuals);
  }
  std::vector<std::byte> bytes;
  append_number(bytes, kNormalStep);
  append_number(bytes, static_cast<std::uint8_t>(predictor));
  append_residuals(bytes, residuals, zstd);
  return bytes;
}

}  // namespace

glm::i16vec2 rounded_normal(glm::i16vec2 normal) {
  return {static_cast<std::int16_t>(rounded_quotient(normal.x) * kNormalStep),
          static_cast<std::int16_t>(rounded_quotient(normal.y) * kNormalStep)};
}

std::vector<std::byte> encode_normals(const Patch& patch, ZstdContexts& zstd) {
  const auto& map = patch.normals;
  const std::vector<std::uint8_t> kept = kept_texels(patch, map.scale);
  const KeptGrid grid{map.width, map.height, kept};
  std::vector<std::byte> plane = encode(patch, grid, NormalPredictor::Plane, zstd);
  if (map.scale > 1) return plane;
  std::vector<std::byte> heights = encode(patch, grid, NormalPredictor::Heights, zstd);
  return heights.size() < plane.size() ? heights : plane;
}

Status decode_normals(std::span<const std::byte> bytes, std::uint32_t scale, Patch& patch,
                      ZstdContexts& zstd) {
  ByteReader in(bytes);
  if (in.left() < 3) return make_error("their step and predictor are missing");
  const std::int32_t step = in.take<std::uint16_t>();
  const auto predictor = in.take<std::uint8_t>();
  const bool on_heights = predictor == static_cast<std::uint8_t>(NormalPredictor::Heights);
  if (step == 0) return make_error("their step is 0");
  if ((!on_heights && predictor != static_cast<std::uint8_t>(NormalPredictor::Plane)) ||
      (on_heights && scale > 1)) {
    return make_error("their predictor is {}", predictor);
  }
  const std::vector<std::uint8_t> kept = kept_texels(patch, scale);
  const auto count = static_cast<std::size_t>(std::count(kept.begin(), kept.end(), 1));
  RELIEF_TRY_ASSIGN(const auto residuals, take_residuals(in, 2 * count, zstd));
  RELIEF_TRY(check_end(in));

  auto& map = patch.normals;
  shape_map(patch, scale, map);
  std::vector<glm::i16vec2> bases(kept.size(), glm::i16vec2(0));
  if (on_heights) bases = normals_of_heights(patch, step);
  std::vector<std::int32_t> values(kept.size());
  for (glm::length_t component = 0; component < 2; ++component) {
    undo_predicted(
        {map.width, map.height, kept},
        std::span(residuals).subspan(component == 0 ? 0 : count, count),
        on_heights ? predict_mean : predict_plane,
        [](std::uint16_t bits) { return std::int32_t{static_cast<std::int16_t>(bits)}; }, values);
    for (std::size_t k = 0; k < kept.size(); ++k) {
      if (kept[k] == 0) continue;
      const std::int64_t value = std::int64_t{values[k] + bases[k][component]} * step;
      if (value < -32767 || value > 32767) return make_error("one lies outside of the octahedron");
      map.texels[k][component] = static_cast<std::int16_t>(value);
    }
  }
  continue_over_holes(map, kept);
  return {};
}

}  // namespace relief
