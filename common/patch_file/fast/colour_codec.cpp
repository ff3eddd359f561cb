// Colour maps in codec 1.
#include <algorithm>
#include <array>

#include "common/io/bytes.h"
#include "common/patch_file/continuation.h"
#include "common/patch_file/fast/patch_codec.h"
#include "common/patch_file/fast/prediction.h"
#include "common/patch_file/fast/residuals.h"

namespace relief {
namespace {

/// Channels in the order in which they are coded. Red and blue follow green closely, so it is their
/// difference to it that is predicted. All arithmetic is modulo 2^8.
struct ColourPlane {
  glm::length_t channel;
  bool relative_to_green;
};
constexpr std::array<ColourPlane, 3> kColourPlanes{{{1, false}, {0, true}, {2, true}}};

/// As zigzag, for differences modulo 2^8.
std::uint8_t zigzag8(std::int32_t difference) {
  const auto wrapped = static_cast<std::int8_t>(difference);
  return static_cast<std::uint8_t>(zigzag(static_cast<std::uint16_t>(wrapped)));
}

}  // namespace

std::vector<std::byte> encode_colours(const Patch& patch, ZstdContexts& zstd) {
  const auto& map = patch.colours;
  const std::vector<std::uint8_t> kept = kept_texels(patch, map.scale);
  std::vector<std::byte> bytes;
  std::vector<std::int32_t> values(kept.size());
  std::vector<std::uint8_t> residuals;
  for (const ColourPlane plane : kColourPlanes) {
    std::transform(map.texels.begin(), map.texels.end(), values.begin(), [plane](glm::u8vec3 c) {
      return (c[plane.channel] - (plane.relative_to_green ? c.g : 0)) & 0xFF;
    });
    residuals.clear();
    visit_predicted({map.width, map.height, kept}, values, predict_plane,
                    [&](std::size_t k, std::int32_t prediction) {
                      residuals.push_back(zigzag8(values[k] - prediction));
                      return values[k];
                    });
    append_stream(bytes, residuals, zstd);
  }
  return bytes;
}

Status decode_colours(std::span<const std::byte> bytes, std::uint32_t scale, Patch& patch,
                      ZstdContexts& zstd) {
  ByteReader in(bytes);
  const std::vector<std::uint8_t> kept = kept_texels(patch, scale);
  const auto count = static_cast<std::size_t>(std::count(kept.begin(), kept.end(), 1));
  auto& map = patch.colours;
  shape_map(patch, scale, map);
  std::vector<std::int32_t> values(kept.size());
  for (const ColourPlane plane : kColourPlanes) {
    const auto stream = take_stream(in, count, zstd);
    if (!stream) return stream.error();
    const std::vector<std::uint16_t> residuals(stream->begin(), stream->end());
    undo_predicted(
        {map.width, map.height, kept}, residuals, predict_plane,
        [](std::uint16_t bits) { return std::int32_t{bits & 0xFF}; }, values);
    for (std::size_t k = 0; k < kept.size(); ++k) {
      if (kept[k] == 0) continue;
      const std::int32_t green = plane.relative_to_green ? map.texels[k].g : 0;
      map.texels[k][plane.channel] = static_cast<std::uint8_t>(values[k] + green);
    }
  }
  if (Status end = check_end(in); !end) return end;
  continue_over_holes(map, kept);
  return {};
}

}  // namespace relief
