// The checksum of the patch file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace relief {

/// Returns the CRC-32 of ISO 3309, as in gzip and PNG.
[[nodiscard]] std::uint32_t crc32(std::span<const std::byte> bytes);

/// Returns whether `bytes` have this crc32. Always true in fuzzing builds: no fuzzer gets past a
/// checksum.
[[nodiscard]] bool has_checksum(std::span<const std::byte> bytes, std::uint32_t checksum);

}  // namespace relief
