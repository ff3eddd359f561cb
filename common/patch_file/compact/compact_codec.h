// Codec 2 of the patch file (compact): the data of codec 1 (patch_codec.h) in about 0.6 of the
// bytes, coarse levels first (docs/patch-file.md, "Codec 2"). Encoders are deterministic. Decoders
// are safe on hostile bytes; their errors are clauses without the file's name.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/error.h"
#include "common/patch.h"

namespace relief {

[[nodiscard]] std::vector<std::byte> encode_heights_compact(const Patch& patch);

/// Sets `patch.heights`; width, height and spacing are set already, to those of the whole patch.
/// `level` of 1 or more decodes only every 2^level-th node in both directions and shrinks the patch
/// to these. `samples` is the expected number of samples among all nodes.
Status decode_heights_compact(std::span<const std::byte> bytes, std::uint32_t samples,
                              unsigned level, Patch& patch);

/// Sets a patch's normals, at its samples, to those derived from its heights.
void take_normals_of_heights(Patch& patch);

/// Returns the step of 16-bit octahedral coordinates whose rounding turns normals by at most
/// `degrees`, 0.1 to 90.
[[nodiscard]] std::uint16_t normal_step(double degrees);

/// Returns the texels as decoded after encode_normals_compact, if they are stored.
[[nodiscard]] std::vector<glm::i16vec2> rounded_normals_compact(const Patch& patch,
                                                                std::uint16_t step);

/// Encodes normals as multiples of `step` of their 16-bit octahedral coordinates; a step of 26
/// means an error of at most 0.1 degrees. At the samples (scale 1) it encodes differences to the
/// normals derived from the heights, and nothing if all are 0.
[[nodiscard]] std::vector<std::byte> encode_normals_compact(const Patch& patch, std::uint16_t step);

/// Sets `patch.normals`; the heights are already decoded. Texels that were not stored continue the
/// others.
Status decode_normals_compact(std::span<const std::byte> bytes, std::uint32_t scale, Patch& patch);

/// Encodes colours exactly, without the texels over holes.
[[nodiscard]] std::vector<std::byte> encode_colours_compact(const Patch& patch);

/// Sets `patch.colours`, as decode_normals_compact does for normals.
Status decode_colours_compact(std::span<const std::byte> bytes, std::uint32_t scale, Patch& patch);

/// As encode_scalar and decode_scalar (fast/patch_codec.h).
[[nodiscard]] std::vector<std::byte> encode_scalar_compact(const Patch& patch,
                                                           const AttributeMap<std::uint16_t>& map);
Result<AttributeMap<std::uint16_t>> decode_scalar_compact(std::span<const std::byte> bytes,
                                                          std::uint32_t scale, const Patch& patch);

}  // namespace relief
