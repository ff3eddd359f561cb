#include "preprocess/readers/gzip/gunzip.h"

#include <unistd.h>

#include <algorithm>

namespace relief {
namespace {

/// Numbers as text are seldom packed tighter.
constexpr std::size_t kLikelyRatio = 8;

/// The size stated at the end of the file: a hint, because a file may have several members.
std::uint64_t stated_size(std::span<const std::byte> bytes) {
  std::uint64_t size = 0;
  for (const std::byte b : bytes.last(std::min<std::size_t>(4, bytes.size())))
    size = size >> 8U | std::to_integer<std::uint64_t>(b) << 24U;
  return size;
}

}  // namespace

std::uint64_t largest_unpacked() {
  const auto pages = static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES));
  const auto page_size = static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
  return pages * page_size / 2;
}

Status gunzip_pieces(const std::string& name, std::span<const std::byte> bytes,
                     const Progress& progress, const TakePiece& take) {
  std::uint64_t unpacked = 0;
  const std::uint64_t most = std::max(kAnyRatioBytes, kLargestRatio * bytes.size());
  return inflate_pieces(
      name, bytes, DeflateForm::Gzip, progress,
      [&](std::span<const std::byte> piece, std::size_t used) -> Result<bool> {
        unpacked += piece.size();
        if (unpacked > most) {
          return make_error(
              "{}: decompresses to more than {} times its size, which no scan should; decompress "
              "it with gunzip first if it is one",
              name, kLargestRatio);
        }
        RELIEF_TRY(take(piece, used));
        return true;
      });
}

Result<std::vector<std::byte>> gunzip(const std::string& name, std::span<const std::byte> bytes,
                                      std::uint64_t limit, const Progress& progress) {
  std::vector<std::byte> out;
  out.reserve(std::min<std::uint64_t>({stated_size(bytes), kLikelyRatio * bytes.size(), limit}));
  const Status unpacked = gunzip_pieces(
      name, bytes, progress, [&](std::span<const std::byte> piece, std::size_t) -> Status {
        if (piece.size() > limit - out.size()) {
          return make_error(
              "{}: decompresses to more than {} MB, which this machine's memory cannot hold", name,
              limit / 1'000'000);
        }
        out.insert(out.end(), piece.begin(), piece.end());
        return {};
      });
  if (!unpacked) return unpacked.error();
  return out;
}

}  // namespace relief
