// gzip, as scans are often packed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "preprocess/readers/source.h"

namespace relief {

/// Whether `bytes` begin as a gzip file does.
[[nodiscard]] bool is_gzip(std::span<const std::byte> bytes);

/// Takes what was unpacked, piece by piece; `used`: packed bytes that it came from, all in all.
using TakePiece = std::function<Status(std::span<const std::byte> piece, std::size_t used)>;

/// Decompresses all members of a gzip file and hands them to `take`, whose failure ends it. `name`
/// begins errors.
Status gunzip_pieces(const std::string& name, std::span<const std::byte> bytes,
                     const Progress& progress, const TakePiece& take);

/// Decompresses all members of a gzip file. The size that the file claims is not trusted: no more
/// than eight times the packed bytes is set aside for it, memory is else taken as bytes come, and a
/// file that grows beyond `limit` bytes is refused. `name` begins errors.
Result<std::vector<std::byte>> gunzip(const std::string& name, std::span<const std::byte> bytes,
                                      std::uint64_t limit, const Progress& progress);

}  // namespace relief
