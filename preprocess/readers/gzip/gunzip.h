// Decompresses gzip files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "preprocess/readers/gzip/inflate.h"
#include "preprocess/readers/source.h"

namespace relief {

/// Receives the decompressed data piece by piece. `used`: total number of compressed bytes read so
/// far.
using TakePiece = std::function<Status(std::span<const std::byte> piece, std::size_t used)>;

/// Scans as text are packed 2 to 20 times smaller, grids of one height more. Deflate allows 1032:
/// 100 MB would unpack to 100 GB.
inline constexpr std::uint64_t kLargestRatio = 200;
/// Below this size any ratio is allowed, bytes.
inline constexpr std::uint64_t kAnyRatioBytes = std::uint64_t{64} << 20U;

/// Returns the largest size of an unpacked file: half of this machine's memory, so that what it
/// holds also fits.
[[nodiscard]] std::uint64_t largest_unpacked();

/// Decompresses all members of a gzip file and passes them to `take`. Stops if `take` fails. Fails
/// once the data are more than kAnyRatioBytes and kLargestRatio times the whole file's size. Errors
/// begin with `name`.
Status gunzip_pieces(const std::string& name, std::span<const std::byte> bytes,
                     const Progress& progress, const TakePiece& take);

/// Decompresses all members of a gzip file. The stated size is not trusted: at most eight times the
/// compressed size is reserved for it, and memory then grows with the data. Fails if the data grow
/// beyond `limit` bytes. Errors begin with `name`.
Result<std::vector<std::byte>> gunzip(const std::string& name, std::span<const std::byte> bytes,
                                      std::uint64_t limit, const Progress& progress);

}  // namespace relief
