#include "common/patch_codec.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "common/bytes.h"
#include "common/continuation.h"
#include "common/mask_codec.h"
#include "common/prediction.h"
#include "common/residuals.h"

namespace relief {
namespace {

std::vector<std::uint8_t> sample_mask(const Patch& patch) {
  std::vector<std::uint8_t> mask(patch.heights.size());
  std::transform(patch.heights.begin(), patch.heights.end(), mask.begin(),
                 [](std::int32_t h) { return static_cast<std::uint8_t>(h != kHole ? 1 : 0); });
  return mask;
}

/// A grid of integers of which some are kept.
struct Grid {
  std::size_t width = 0;
  std::size_t height = 0;
  const std::uint8_t* kept = nullptr;
};

/// Calls `visit(k, prediction)` for each kept node in scan order; it returns the value there.
template <class Value, class Visit>
void visit_predicted(const Grid& grid, const Value* values, const Visit& visit) {
  std::int32_t last = 0;
  for (std::size_t j = 0; j < grid.height; ++j) {
    for (std::size_t i = 0; i < grid.width; ++i) {
      const std::size_t k = j * grid.width + i;
      if (grid.kept[k] == 0) continue;
      last = visit(k, predict(values, grid.kept, grid.width, i, j, last));
    }
  }
}

/// Appends the residual of each kept value, modulo 2^16.
void append_predicted(const Grid& grid, std::span<const std::int32_t> values,
                      std::vector<std::uint16_t>& residuals) {
  visit_predicted(grid, values.data(), [&](std::size_t k, std::int32_t prediction) {
    residuals.push_back(zigzag(static_cast<std::uint16_t>(values[k] - prediction)));
    return values[k];
  });
}

/// The inverse: sets each kept value, as a 16-bit number that `from_bits` interprets, and moves
/// `residual` on.
template <class FromBits>
void undo_predicted(const Grid& grid, const std::uint16_t*& residual, const FromBits& from_bits,
                    std::span<std::int32_t> values) {
  visit_predicted(grid, values.data(), [&](std::size_t k, std::int32_t prediction) {
    values[k] = from_bits(static_cast<std::uint16_t>(prediction + unzigzag(*residual++)));
    return values[k];
  });
}

std::int32_t as_unsigned(std::uint16_t bits) {
  return bits;
}
std::int32_t as_signed(std::uint16_t bits) {
  return static_cast<std::int16_t>(bits);
}
/// Colours are predicted modulo 2^8.
std::int32_t as_byte(std::uint16_t bits) {
  return bits & 0xFF;
}

std::int32_t rounded_quotient(std::int32_t value) {
  constexpr std::int32_t kHalf = kNormalStep / 2;
  return value >= 0 ? (value + kHalf) / kNormalStep : -((-value + kHalf) / kNormalStep);
}

/// Sizes a map for `patch` and returns which of its texels are kept.
template <class Texel>
std::vector<std::uint8_t> shape_map(const Patch& patch, std::uint32_t scale,
                                    AttributeMap<Texel>& map) {
  map.scale = scale;
  map.width = scale * (patch.width - 1) + 1;
  map.height = scale * (patch.height - 1) + 1;
  map.texels.assign(std::size_t{map.width} * map.height, Texel(0));
  return kept_texels(patch, scale);
}

std::size_t count_kept(std::span<const std::uint8_t> kept) {
  return static_cast<std::size_t>(std::count(kept.begin(), kept.end(), std::uint8_t{1}));
}

/// What is left when everything is decoded is a sign that writer and reader disagree.
Status check_end(const ByteReader& in) {
  if (in.left() > 0) return make_error("{} bytes are left after the last stream", in.left());
  return {};
}

}  // namespace

std::vector<std::uint8_t> kept_texels(const Patch& patch, std::uint32_t scale) {
  const std::vector<std::uint8_t> mask = sample_mask(patch);
  if (scale == 1) return mask;
  const std::size_t width = std::size_t{scale} * (patch.width - 1) + 1;
  const std::size_t height = std::size_t{scale} * (patch.height - 1) + 1;
  std::vector<std::uint8_t> kept(width * height);
  for (std::size_t b = 0; b < height; ++b) {
    const std::size_t south = b / scale * patch.width;
    const std::size_t north = (b + scale - 1) / scale * patch.width;
    for (std::size_t a = 0; a < width; ++a) {
      const std::size_t west = a / scale;
      const std::size_t east = (a + scale - 1) / scale;
      kept[b * width + a] =
          mask[south + west] | mask[south + east] | mask[north + west] | mask[north + east];
    }
  }
  return kept;
}

std::vector<std::byte> encode_heights(const Patch& patch) {
  const std::vector<std::uint8_t> mask = sample_mask(patch);
  std::vector<std::byte> bytes;
  append_mask(bytes, mask, patch.width);
  std::vector<std::uint16_t> residuals;
  residuals.reserve(mask.size());
  append_predicted({patch.width, patch.height, mask.data()}, patch.heights, residuals);
  append_residuals(bytes, residuals);
  return bytes;
}

Status decode_heights(std::span<const std::byte> bytes, std::uint32_t samples, Patch& patch) {
  ByteReader in(bytes);
  const auto mask = take_mask(in, patch.width, patch.height);
  if (!mask) return mask.error();
  const std::size_t marked = count_kept(*mask);
  if (marked != samples) {
    return make_error("the mask has {} samples where the index says {}", marked, samples);
  }
  const auto residuals = take_residuals(in, marked);
  if (!residuals) return residuals.error();
  if (Status end = check_end(in); !end) return end;

  patch.heights.assign(mask->size(), kHole);
  const std::uint16_t* residual = residuals->data();
  undo_predicted({patch.width, patch.height, mask->data()}, residual, as_unsigned, patch.heights);
  if (std::any_of(patch.heights.begin(), patch.heights.end(),
                  [](std::int32_t h) { return h > kMaxHeightRange; })) {
    return make_error("a height lies above {}", kMaxHeightRange);
  }
  return {};
}

glm::i16vec2 rounded_normal(glm::i16vec2 normal) {
  return {static_cast<std::int16_t>(rounded_quotient(normal.x) * kNormalStep),
          static_cast<std::int16_t>(rounded_quotient(normal.y) * kNormalStep)};
}

std::vector<std::byte> encode_normals(const Patch& patch) {
  const auto& map = patch.normals;
  const std::vector<std::uint8_t> kept = kept_texels(patch, map.scale);
  std::vector<std::uint16_t> residuals;
  residuals.reserve(2 * kept.size());
  std::vector<std::int32_t> values(kept.size());
  for (glm::length_t component = 0; component < 2; ++component) {
    std::transform(map.texels.begin(), map.texels.end(), values.begin(),
                   [component](glm::i16vec2 n) { return rounded_quotient(n[component]); });
    append_predicted({map.width, map.height, kept.data()}, values, residuals);
  }
  std::vector<std::byte> bytes;
  append_number(bytes, kNormalStep);
  append_residuals(bytes, residuals);
  return bytes;
}

Status decode_normals(std::span<const std::byte> bytes, std::uint32_t scale, Patch& patch) {
  ByteReader in(bytes);
  if (in.left() < 2) return make_error("the normals' step is missing");
  const std::int32_t step = in.take<std::uint16_t>();
  if (step == 0) return make_error("the normals' step is 0");
  const std::vector<std::uint8_t> kept = shape_map(patch, scale, patch.normals);
  const auto residuals = take_residuals(in, 2 * count_kept(kept));
  if (!residuals) return residuals.error();
  if (Status end = check_end(in); !end) return end;

  auto& map = patch.normals;
  const std::uint16_t* residual = residuals->data();
  std::vector<std::int32_t> values(kept.size());
  for (glm::length_t component = 0; component < 2; ++component) {
    undo_predicted({map.width, map.height, kept.data()}, residual, as_signed, values);
    for (std::size_t k = 0; k < kept.size(); ++k) {
      if (kept[k] == 0) continue;
      const std::int32_t value = values[k] * step;
      if (value < -32767 || value > 32767) {
        return make_error("a normal lies outside of the octahedron");
      }
      map.texels[k][component] = static_cast<std::int16_t>(value);
    }
  }
  continue_over_holes(map, kept);
  return {};
}

namespace {

/// Colour channels in the order in which they are coded, and what the later ones are coded
/// relative to: red and blue follow green closely.
struct ColourPlane {
  glm::length_t channel;
  bool relative_to_green;
};
constexpr std::array<ColourPlane, 3> kColourPlanes{{{1, false}, {0, true}, {2, true}}};

std::uint16_t zigzag8(std::int32_t difference) {
  const auto byte = static_cast<std::int8_t>(difference);
  return zigzag(static_cast<std::uint16_t>(byte));
}

}  // namespace

std::vector<std::byte> encode_colours(const Patch& patch) {
  const auto& map = patch.colours;
  const std::vector<std::uint8_t> kept = kept_texels(patch, map.scale);
  const Grid grid{map.width, map.height, kept.data()};
  std::vector<std::byte> bytes;
  std::vector<std::int32_t> values(kept.size());
  for (const ColourPlane plane : kColourPlanes) {
    std::transform(map.texels.begin(), map.texels.end(), values.begin(), [plane](glm::u8vec3 c) {
      return (c[plane.channel] - (plane.relative_to_green ? c.g : 0)) & 0xFF;
    });
    std::vector<std::uint8_t> residuals;
    residuals.reserve(kept.size());
    visit_predicted(grid, values.data(), [&](std::size_t k, std::int32_t prediction) {
      residuals.push_back(static_cast<std::uint8_t>(zigzag8(values[k] - prediction)));
      return values[k];
    });
    append_stream(bytes, residuals);
  }
  return bytes;
}

Status decode_colours(std::span<const std::byte> bytes, std::uint32_t scale, Patch& patch) {
  ByteReader in(bytes);
  const std::vector<std::uint8_t> kept = shape_map(patch, scale, patch.colours);
  const std::size_t count = count_kept(kept);
  auto& map = patch.colours;
  const Grid grid{map.width, map.height, kept.data()};
  std::vector<std::int32_t> values(kept.size());
  for (const ColourPlane plane : kColourPlanes) {
    const auto stream = take_stream(in, count);
    if (!stream) return stream.error();
    const std::uint8_t* residual = stream->data();
    visit_predicted(grid, values.data(), [&](std::size_t k, std::int32_t prediction) {
      values[k] = as_byte(static_cast<std::uint16_t>(prediction + unzigzag(*residual++)));
      return values[k];
    });
    for (std::size_t k = 0; k < kept.size(); ++k) {
      const std::int32_t green = plane.relative_to_green ? map.texels[k].g : 0;
      map.texels[k][plane.channel] = static_cast<std::uint8_t>(values[k] + green);
    }
  }
  if (Status end = check_end(in); !end) return end;
  continue_over_holes(map, kept);
  return {};
}

}  // namespace relief
