// Attribute maps in codec 2 of the patch file.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "common/io/bytes.h"
#include "common/patch_file/compact/compact_codec.h"
#include "common/patch_file/compact/rans.h"
#include "common/patch_file/compact/residual_classes.h"
#include "common/patch_file/continuation.h"
#include "common/patch_file/fast/patch_codec.h"
#include "common/patch_file/fast/prediction.h"
#include "common/patch_file/fast/residuals.h"
#include "common/patch_file/normals_of_heights.h"
#include "common/patch_file/patch_file.h"

namespace relief {
namespace {

/// The expected magnitude of residuals before any are known, in 1/256.
constexpr std::uint32_t kFirstExpectation = 8 << kExpectationBits;

/// Values are signed in this codec; the codes of scalars are not.
constexpr std::int32_t kScalarMiddle = 32768;

/// The magnitude, in 1/256, that the residuals of one channel have around texel k: those to the
/// west and north count three times as much as those to the north-west and north-east.
std::uint32_t expectation_at(const Neighbours& magnitudes) {
  const std::uint32_t weight = (magnitudes.west ? 3U : 0U) + (magnitudes.north ? 3U : 0U) +
                               (magnitudes.north_west ? 1U : 0U) +
                               (magnitudes.north_east ? 1U : 0U);
  if (weight == 0) return kFirstExpectation;
  const auto sum =
      static_cast<std::uint32_t>(3 * (magnitudes.w + magnitudes.n) + magnitudes.nw + magnitudes.ne);
  return (sum << kExpectationBits) / weight;
}

/// Calls `code(channel, k, prediction, residual class)` for every kept texel in scan order, all
/// channels of one before those of the next; it sets or reads the value and returns the residual.
/// The expected residual is that of those around it and, with half the weight, that of the previous
/// channel.
template <std::size_t Channels, class Predict, class Code>
void visit_map(const KeptGrid& grid, const std::array<std::vector<std::int32_t>, Channels>& values,
               const Predict& predict, const Code& code) {
  std::array<std::vector<std::int32_t>, Channels> magnitudes;
  magnitudes.fill(std::vector<std::int32_t>(grid.kept.size()));
  std::array<std::int32_t, Channels> last{};
  std::size_t k = 0;
  for (std::size_t j = 0; j < grid.height; ++j) {
    for (std::size_t i = 0; i < grid.width; ++i, ++k) {
      if (grid.kept[k] == 0) continue;
      std::uint32_t before = 0;
      for (std::size_t c = 0; c < Channels; ++c) {
        std::uint32_t expected =
            expectation_at(neighbours_at(grid, std::span<const std::int32_t>(magnitudes[c]), i, k));
        if (c > 0) expected = (2 * expected + before) / 3;
        const std::int32_t prediction =
            predict(neighbours_at(grid, std::span<const std::int32_t>(values[c]), i, k), last[c]);
        const std::int32_t magnitude = std::abs(code(c, k, prediction, class_of(expected)));
        magnitudes[c][k] = magnitude;
        before = static_cast<std::uint32_t>(magnitude) << kExpectationBits;
        last[c] = values[c][k];
      }
    }
  }
}

template <std::size_t Channels, class Predict>
std::vector<std::byte> encode_map(const KeptGrid& grid,
                                  const std::array<std::vector<std::int32_t>, Channels>& values,
                                  const Predict& predict) {
  RansEncoder out;
  visit_map(grid, values, predict,
            [&](std::size_t c, std::size_t k, std::int32_t prediction, unsigned residual_class) {
              const std::int32_t r = wrapped(values[c][k] - prediction);
              put_residual(out, residual_class, zigzag(static_cast<std::uint16_t>(r)));
              return r;
            });
  std::vector<std::byte> bytes;
  out.finish(bytes);
  return bytes;
}

template <std::size_t Channels, class Predict>
Status decode_map(std::span<const std::byte> bytes, const KeptGrid& grid, const Predict& predict,
                  std::array<std::vector<std::int32_t>, Channels>& values) {
  values.fill(std::vector<std::int32_t>(grid.kept.size()));
  RansDecoder in(bytes);
  const auto& classes = residual_classes();
  visit_map(grid, values, predict,
            [&](std::size_t c, std::size_t k, std::int32_t prediction, unsigned residual_class) {
              const std::uint16_t r = unzigzag(take_residual(in, classes, residual_class));
              values[c][k] = wrapped(prediction + r);
              return wrapped(r);
            });
  if (!in.is_at_end()) return make_error("they do not end where they should");
  return {};
}

/// The base and the step of coded normals.
struct NormalFrame {
  std::uint16_t step = 1;
  std::vector<glm::i16vec2> bases;  ///< the heights' own normals; zero for maps finer than the grid
};

std::int32_t rounded_quotient(std::int32_t value, std::int32_t step) {
  const std::int32_t half = step / 2;
  return value >= 0 ? (value + half) / step : -((half - value) / step);
}

/// The inverse of rounded_quotient about `base`, within the octahedron.
std::int16_t restored(std::int32_t quotient, std::int32_t step, std::int32_t base) {
  return static_cast<std::int16_t>(std::clamp(quotient * step + base, -32767, 32767));
}

NormalFrame frame_of(const Patch& patch, std::uint32_t scale, std::size_t texels,
                     std::uint16_t step) {
  if (scale == 1) return {step, normals_of_heights(patch, 1)};
  return {step, std::vector<glm::i16vec2>(texels, glm::i16vec2(0))};
}

std::int32_t predict_normal(const Neighbours& at, std::int32_t last, std::uint32_t scale) {
  return scale == 1 ? predict_mean(at, last) : predict_plane(at, last);
}

}  // namespace

void take_normals_of_heights(Patch& patch) {
  shape_map(patch, 1, patch.normals);
  patch.normals.texels = normals_of_heights(patch, 1);
  continue_over_holes(patch.normals, sample_mask(patch));
}

std::vector<std::byte> encode_normals_compact(const Patch& patch, std::uint16_t step) {
  const auto& map = patch.normals;
  const std::vector<std::uint8_t> kept = kept_texels(patch, map.scale);
  const NormalFrame frame = frame_of(patch, map.scale, map.texels.size(), step);
  std::array<std::vector<std::int32_t>, 2> values;
  for (std::size_t c = 0; c < 2; ++c) {
    values[c].resize(map.texels.size());
    for (std::size_t k = 0; k < map.texels.size(); ++k) {
      const auto component = static_cast<glm::length_t>(c);
      if (kept[k] != 0) {
        values[c][k] = rounded_quotient(map.texels[k][component] - frame.bases[k][component], step);
      }
    }
  }
  const auto is_zero = [](const std::vector<std::int32_t>& channel) {
    return std::all_of(channel.begin(), channel.end(), [](std::int32_t v) { return v == 0; });
  };
  if (map.scale == 1 && is_zero(values[0]) && is_zero(values[1])) return {};
  const std::vector<std::byte> coded = encode_map(
      {map.width, map.height, kept}, values,
      [&](const Neighbours& at, std::int32_t last) { return predict_normal(at, last, map.scale); });
  std::vector<std::byte> bytes;
  append_number(bytes, step);
  bytes.insert(bytes.end(), coded.begin(), coded.end());
  return bytes;
}

std::uint16_t normal_step(double degrees) {
  return static_cast<std::uint16_t>(
      std::lround(std::clamp(degrees, kMinNormalDegrees, kMaxNormalDegrees) * 10.0 * kNormalStep));
}

std::vector<glm::i16vec2> rounded_normals_compact(const Patch& patch, std::uint16_t step) {
  std::vector<glm::i16vec2> normals = patch.normals.texels;
  const NormalFrame frame = frame_of(patch, patch.normals.scale, normals.size(), step);
  for (std::size_t k = 0; k < normals.size(); ++k) {
    for (glm::length_t c = 0; c < 2; ++c) {
      normals[k][c] = restored(rounded_quotient(normals[k][c] - frame.bases[k][c], step), step,
                               frame.bases[k][c]);
    }
  }
  return normals;
}

Status decode_normals_compact(std::span<const std::byte> bytes, std::uint32_t scale, Patch& patch) {
  if (bytes.empty() && scale == 1) {
    take_normals_of_heights(patch);
    return {};
  }
  ByteReader in(bytes);
  if (in.left() < 2) return make_error("their step is missing");
  const auto step = in.take<std::uint16_t>();
  if (step == 0) return make_error("their step is 0");
  const std::vector<std::uint8_t> kept = kept_texels(patch, scale);
  auto& map = patch.normals;
  shape_map(patch, scale, map);
  std::array<std::vector<std::int32_t>, 2> values;
  Status decoded = decode_map(
      in.take_bytes(in.left()), {map.width, map.height, kept},
      [scale](const Neighbours& at, std::int32_t last) { return predict_normal(at, last, scale); },
      values);
  if (!decoded) return decoded;
  const NormalFrame frame = frame_of(patch, scale, map.texels.size(), step);
  for (std::size_t k = 0; k < kept.size(); ++k) {
    if (kept[k] == 0) continue;
    for (glm::length_t c = 0; c < 2; ++c) {
      map.texels[k][c] = restored(values[static_cast<std::size_t>(c)][k], step, frame.bases[k][c]);
    }
  }
  continue_over_holes(map, kept);
  return {};
}

std::vector<std::byte> encode_colours_compact(const Patch& patch) {
  const auto& map = patch.colours;
  const std::vector<std::uint8_t> kept = kept_texels(patch, map.scale);
  std::array<std::vector<std::int32_t>, 3> values;
  for (auto& channel : values) channel.resize(map.texels.size());
  for (std::size_t k = 0; k < map.texels.size(); ++k) {
    const glm::ivec3 c(map.texels[k]);
    values[0][k] = c.g;
    values[1][k] = c.r - c.g;
    values[2][k] = c.b - c.g;
  }
  return encode_map({map.width, map.height, kept}, values, predict_median);
}

Status decode_colours_compact(std::span<const std::byte> bytes, std::uint32_t scale, Patch& patch) {
  const std::vector<std::uint8_t> kept = kept_texels(patch, scale);
  auto& map = patch.colours;
  shape_map(patch, scale, map);
  std::array<std::vector<std::int32_t>, 3> values;
  Status decoded = decode_map(bytes, {map.width, map.height, kept}, predict_median, values);
  if (!decoded) return decoded;
  for (std::size_t k = 0; k < kept.size(); ++k) {
    if (kept[k] == 0) continue;
    const std::int32_t g = values[0][k];
    map.texels[k] = {static_cast<std::uint8_t>(values[1][k] + g), static_cast<std::uint8_t>(g),
                     static_cast<std::uint8_t>(values[2][k] + g)};
  }
  continue_over_holes(map, kept);
  return {};
}

std::vector<std::byte> encode_scalar_compact(const Patch& patch,
                                             const AttributeMap<std::uint16_t>& map) {
  const std::vector<std::uint8_t> kept = kept_texels(patch, map.scale);
  std::array<std::vector<std::int32_t>, 1> values;
  values[0].reserve(map.texels.size());
  for (const std::uint16_t code : map.texels) values[0].push_back(code - kScalarMiddle);
  return encode_map({map.width, map.height, kept}, values, predict_median);
}

Result<AttributeMap<std::uint16_t>> decode_scalar_compact(std::span<const std::byte> bytes,
                                                          std::uint32_t scale, const Patch& patch) {
  const std::vector<std::uint8_t> kept = kept_texels(patch, scale);
  AttributeMap<std::uint16_t> map;
  shape_map(patch, scale, map);
  std::array<std::vector<std::int32_t>, 1> values;
  RELIEF_TRY(decode_map(bytes, {map.width, map.height, kept}, predict_median, values));
  for (std::size_t k = 0; k < kept.size(); ++k) {
    map.texels[k] =
        kept[k] == 0 ? kNoScalar : static_cast<std::uint16_t>(values[0][k] + kScalarMiddle);
  }
  return map;
}

}  // namespace relief
