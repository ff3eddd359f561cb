// Codec 1 of the patch file: heights and attribute maps as predicted integers, and back
// (docs/patch-file.md, "Codec 1"). Encoders give the same bytes for the same patch; decoders are
// safe on hostile bytes, and their errors are clauses without the file's name.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/error.h"
#include "common/patch.h"
#include "common/patch_file/fast/zstd_contexts.h"

namespace relief {

/// Normals are kept as multiples of this many steps of their 16-bit octahedral coordinates. The
/// largest error is then 0.1 degrees (near the middle of the octahedron's faces, half of that near
/// the patch's own normal), and a normal costs 9 bits less than one that is kept exactly.
inline constexpr std::uint16_t kNormalStep = 26;

/// 1 for each node that is a sample, 0 for holes. Row-major.
[[nodiscard]] std::vector<std::uint8_t> sample_mask(const Patch& patch);

/// How many are 1 in a mask of 0 and 1.
[[nodiscard]] std::uint32_t count_marked(std::span<const std::uint8_t> mask);

/// Which texels of a map of `scale` texels per cell are kept: those in a cell, on an edge or on a
/// node that touches a sample. Row-major, 1 or 0. For scale 1 these are the samples.
[[nodiscard]] std::vector<std::uint8_t> kept_texels(const Patch& patch, std::uint32_t scale);

[[nodiscard]] std::vector<std::byte> encode_heights(const Patch& patch, ZstdContexts& zstd);

/// Sets `patch.heights`; width and height are set already. `samples` is how many of the nodes have
/// to be samples.
Status decode_heights(std::span<const std::byte> bytes, std::uint32_t samples, Patch& patch,
                      ZstdContexts& zstd);

/// Rounds normals to kNormalStep; texels that are not kept are lost.
[[nodiscard]] std::vector<std::byte> encode_normals(const Patch& patch, ZstdContexts& zstd);

/// Sets `patch.normals`; the heights are decoded already. Texels that were not kept continue the
/// others.
Status decode_normals(std::span<const std::byte> bytes, std::uint32_t scale, Patch& patch,
                      ZstdContexts& zstd);

/// The normal as it comes back from the file.
[[nodiscard]] glm::i16vec2 rounded_normal(glm::i16vec2 normal);

/// Keeps colours exactly; texels that are not kept are lost.
[[nodiscard]] std::vector<std::byte> encode_colours(const Patch& patch, ZstdContexts& zstd);

/// As decode_normals, for `patch.colours`.
Status decode_colours(std::span<const std::byte> bytes, std::uint32_t scale, Patch& patch,
                      ZstdContexts& zstd);

/// Sizes a map for `patch`.
template <class Texel>
void shape_map(const Patch& patch, std::uint32_t scale, AttributeMap<Texel>& map) {
  map.scale = scale;
  map.width = scale * (patch.width - 1) + 1;
  map.height = scale * (patch.height - 1) + 1;
  map.texels.assign(std::size_t{map.width} * map.height, Texel(0));
}

}  // namespace relief
