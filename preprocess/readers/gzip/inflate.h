// Decompresses DEFLATE data piece by piece.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>

#include "common/error.h"
#include "common/progress.h"

namespace relief {

/// What is around DEFLATE data (RFC 1951).
enum class DeflateForm : std::uint8_t {
  Gzip,  ///< RFC 1952, several members, zeros at the end
  Zlib,  ///< RFC 1950
  Raw    ///< nothing
};

/// Returns whether `bytes` begin as a gzip file.
[[nodiscard]] bool is_gzip(std::span<const std::byte> bytes);

/// The largest ratio of decompressed to compressed bytes that DEFLATE allows.
inline constexpr std::uint64_t kDeflateRatio = 1032;

/// Receives the decompressed data piece by piece and returns whether to go on. `used`: total number
/// of compressed bytes read so far.
using TakeInflated =
    std::function<Result<bool>(std::span<const std::byte> piece, std::size_t used)>;

/// Decompresses data and passes them to `take`, until they end or `take` returns false or fails.
/// Checks the checksums of gzip and zlib if it reaches the end. Bytes after the end of zlib and raw
/// data are ignored. Errors begin with `name`.
Status inflate_pieces(const std::string& name, std::span<const std::byte> bytes, DeflateForm form,
                      const Progress& progress, const TakeInflated& take);

}  // namespace relief
