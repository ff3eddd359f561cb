// Codec 2 of the patch file: what codec 1 keeps (patch_codec.h) in about 0.6 of the bytes, coarse
// levels first (docs/patch-file.md, "Codec 2"). Encoders give the same bytes for the same patch;
// decoders are safe on hostile bytes, and their errors are clauses without the file's name.
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
/// `level` of 1 and more decodes every 2^level-th node each way and no other, and leaves the patch
/// with these nodes alone. `samples` is how many of all nodes have to be samples.
Status decode_heights_compact(std::span<const std::byte> bytes, std::uint32_t samples,
                              unsigned level, Patch& patch);

/// Gives a patch the normals of its heights, at its samples.
void take_normals_of_heights(Patch& patch);

/// The step of 16-bit octahedral coordinates whose rounding turns normals by at most `degrees`, 0.1
/// to 90.
[[nodiscard]] std::uint16_t normal_step(double degrees);

/// The texels as they come back from encode_normals_compact, if they are kept.
[[nodiscard]] std::vector<glm::i16vec2> rounded_normals_compact(const Patch& patch,
                                                                std::uint16_t step);

/// Keeps normals in multiples of `step` of their 16-bit octahedral coordinates: of 26 an error of
/// at most 0.1 degrees. On the samples themselves (scale 1) these are differences to the normals of
/// the heights; empty if all are 0.
[[nodiscard]] std::vector<std::byte> encode_normals_compact(const Patch& patch, std::uint16_t step);

/// Sets `patch.normals`; the heights are decoded already. Texels that were not kept continue the
/// others.
Status decode_normals_compact(std::span<const std::byte> bytes, std::uint32_t scale, Patch& patch);

/// Keeps colours exactly; texels that are not kept are lost.
[[nodiscard]] std::vector<std::byte> encode_colours_compact(const Patch& patch);

/// As decode_normals_compact, for `patch.colours`.
Status decode_colours_compact(std::span<const std::byte> bytes, std::uint32_t scale, Patch& patch);

}  // namespace relief
