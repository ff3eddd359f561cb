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

namespace relief {

/// Normals are kept as multiples of this many steps of their 16-bit octahedral coordinates. The
/// largest error is then 0.097 degrees (near the octahedron's face centres; 0.05 near the plane's
/// normal), and a normal costs 9 bits less than one that is kept exactly.
inline constexpr std::uint16_t kNormalStep = 26;

/// Which texels of a map of `scale` texels per cell are kept: those in a cell, on an edge or on a
/// node that touches a sample. Row-major, 1 or 0. For scale 1 these are the samples.
std::vector<std::uint8_t> kept_texels(const Patch& patch, std::uint32_t scale);

std::vector<std::byte> encode_heights(const Patch& patch);

/// Sets `patch.heights`; width and height are set already. `samples` is how many of the nodes have
/// to be samples; all heights must lie in 0..kMaxHeightRange.
Status decode_heights(std::span<const std::byte> bytes, std::uint32_t samples, Patch& patch);

/// Rounds normals to kNormalStep; texels that are not kept are lost.
std::vector<std::byte> encode_normals(const Patch& patch);

/// Sets `patch.normals`; the heights are decoded already. Texels that were not kept continue the
/// others.
Status decode_normals(std::span<const std::byte> bytes, std::uint32_t scale, Patch& patch);

/// Keeps colours exactly; texels that are not kept are lost.
std::vector<std::byte> encode_colours(const Patch& patch);

/// As decode_normals, for `patch.colours`.
Status decode_colours(std::span<const std::byte> bytes, std::uint32_t scale, Patch& patch);

/// The normal as it comes back from the file.
[[nodiscard]] glm::i16vec2 rounded_normal(glm::i16vec2 normal);

}  // namespace relief
