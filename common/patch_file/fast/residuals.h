// Residuals of predicted integers as zstd streams: the last stage of codec 1 of the patch file
// (docs/patch-file.md, "Residual streams").
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "common/error.h"
#include "common/io/bytes.h"
#include "common/patch_file/fast/zstd_contexts.h"

namespace relief {

/// Appends `bytes` as a stream: its compressed size in 4 bytes, then a zstd frame; size 0 if all
/// bytes are zero.
void append_stream(std::vector<std::byte>& out, std::span<const std::uint8_t> bytes,
                   ZstdContexts& zstd);

/// Decodes a stream of a known decoded size. Safe on hostile bytes: allocates only `decoded_size`
/// bytes. Errors are clauses without the file's name ("the stream ...").
Result<std::vector<std::uint8_t>> take_stream(ByteReader& in, std::size_t decoded_size,
                                              ZstdContexts& zstd);

/// Appends `bytes` as a stream that stores its decoded size. Unlike append_stream, size 0 means
/// that there are no bytes.
void append_sized_stream(std::vector<std::byte>& out, std::span<const std::uint8_t> bytes,
                         ZstdContexts& zstd);

/// Decodes a stream of append_sized_stream; fails if it has more than `largest` bytes.
Result<std::vector<std::uint8_t>> take_sized_stream(ByteReader& in, std::size_t largest,
                                                    ZstdContexts& zstd);

/// Appends 16-bit residuals as two streams, low bytes and high bytes. The high bytes are nearly
/// always zero and then cost nothing.
void append_residuals(std::vector<std::byte>& out, std::span<const std::uint16_t> residuals,
                      ZstdContexts& zstd);

/// Inverse of append_residuals, for `count` residuals.
Result<std::vector<std::uint16_t>> take_residuals(ByteReader& in, std::size_t count,
                                                  ZstdContexts& zstd);

/// Decodes residuals to differences (unzigzag), followed by `padding` zeros.
Result<std::vector<std::uint16_t>> take_differences(ByteReader& in, std::size_t count,
                                                    std::size_t padding, ZstdContexts& zstd);

/// Fails if bytes are left after decoding, since writer and reader then disagree.
Status check_end(const ByteReader& in);

/// Returns a signed number with zigzag coding: 0, -1, 1, -2 ... become 0, 1, 2, 3 ... All
/// arithmetic is modulo 2^16, so every pair of value and prediction has a residual.
[[nodiscard]] constexpr std::uint16_t zigzag(std::uint16_t difference) {
  return static_cast<std::uint16_t>((difference << 1U) ^
                                    ((difference & 0x8000U) != 0 ? 0xFFFFU : 0U));
}

/// Inverse of zigzag.
[[nodiscard]] constexpr std::uint16_t unzigzag(std::uint16_t residual) {
  return static_cast<std::uint16_t>((residual >> 1U) ^ ((residual & 1U) != 0 ? 0xFFFFU : 0U));
}

/// Returns the magnitude of the difference whose zigzag number is `residual`.
[[nodiscard]] constexpr std::uint32_t magnitude_of(std::uint32_t residual) {
  return (residual + 1) / 2;
}

/// Returns a difference modulo 2^16, within -32768 to 32767.
[[nodiscard]] constexpr std::int32_t wrapped(std::int32_t difference) {
  return static_cast<std::int16_t>(static_cast<std::uint16_t>(difference));
}

}  // namespace relief
