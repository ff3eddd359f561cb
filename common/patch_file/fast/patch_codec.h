// Codec 1 of the patch file (fast): heights and attribute maps as predicted integers, and back
// (docs/patch-file.md, "Codec 1"). Encoders are deterministic. Decoders are safe on hostile bytes;
// their errors are clauses without the file's name.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/error.h"
#include "common/patch.h"
#include "common/patch_file/fast/zstd_contexts.h"

namespace relief {

/// Normals are rounded to multiples of this many steps of their 16-bit octahedral coordinates. The
/// largest error is 0.1 degrees (at the middle of the octahedron's faces; half of that near the
/// patch's normal), and a normal costs 9 bits less than an exact one.
inline constexpr std::uint16_t kNormalStep = 26;

/// Returns the mask of a patch: 1 for samples, 0 for holes; row-major.
[[nodiscard]] std::vector<std::uint8_t> sample_mask(const Patch& patch);

/// Returns the number of ones in a mask.
[[nodiscard]] std::uint32_t count_marked(std::span<const std::uint8_t> mask);

/// Returns the mask of stored texels of a map of `scale` texels per cell: those in a cell, on an
/// edge or on a node that touches a sample. Row-major, 1 or 0. For scale 1 these are the samples.
[[nodiscard]] std::vector<std::uint8_t> kept_texels(const Patch& patch, std::uint32_t scale);

[[nodiscard]] std::vector<std::byte> encode_heights(const Patch& patch, ZstdContexts& zstd);

/// Sets `patch.heights`; width and height are already set. `samples` is the expected number of
/// samples.
Status decode_heights(std::span<const std::byte> bytes, std::uint32_t samples, Patch& patch,
                      ZstdContexts& zstd);

/// Encodes normals rounded to kNormalStep, without the texels over holes.
[[nodiscard]] std::vector<std::byte> encode_normals(const Patch& patch, ZstdContexts& zstd);

/// Sets `patch.normals`; the heights are already decoded. Texels that were not stored continue the
/// others.
Status decode_normals(std::span<const std::byte> bytes, std::uint32_t scale, Patch& patch,
                      ZstdContexts& zstd);

/// Returns the normal as decoded from the file.
[[nodiscard]] glm::i16vec2 rounded_normal(glm::i16vec2 normal);

/// Encodes colours exactly, without the texels over holes.
[[nodiscard]] std::vector<std::byte> encode_colours(const Patch& patch, ZstdContexts& zstd);

/// Sets `patch.colours`, as decode_normals does for normals.
Status decode_colours(std::span<const std::byte> bytes, std::uint32_t scale, Patch& patch,
                      ZstdContexts& zstd);

/// Encodes the codes of a scalar exactly, without the texels over holes.
[[nodiscard]] std::vector<std::byte> encode_scalar(const Patch& patch,
                                                   const AttributeMap<std::uint16_t>& map,
                                                   ZstdContexts& zstd);

/// Returns the map of a scalar; the heights are already decoded. Texels that were not stored are
/// kNoScalar.
Result<AttributeMap<std::uint16_t>> decode_scalar(std::span<const std::byte> bytes,
                                                  std::uint32_t scale, const Patch& patch,
                                                  ZstdContexts& zstd);

/// Sets the size of a map for `patch`.
template <class Texel>
void shape_map(const Patch& patch, std::uint32_t scale, AttributeMap<Texel>& map) {
  map.scale = scale;
  map.width = scale * (patch.width - 1) + 1;
  map.height = scale * (patch.height - 1) + 1;
  map.texels.assign(std::size_t{map.width} * map.height, Texel(0));
}

}  // namespace relief
