#include "preprocess/readers/gunzip.h"

#include <zlib.h>

#include <algorithm>
#include <memory>

namespace relief {
namespace {

constexpr unsigned kZipMagic[] = {0x1F, 0x8B};
/// zlib's window is 32 KiB; a call handles at most 4 GiB.
constexpr std::size_t kStep = std::size_t{1} << 20U;
/// Bytes that are unpacked at a time.
constexpr std::size_t kPieceBytes = std::size_t{64} << 10U;

struct EndInflate {
  void operator()(z_stream* stream) const { inflateEnd(stream); }
};

/// Numbers as text are seldom packed tighter.
constexpr std::size_t kLikelyRatio = 8;

/// The size stated at the end of the file: a hint, because a file may have several members.
std::uint64_t stated_size(std::span<const std::byte> bytes) {
  std::uint64_t size = 0;
  for (const std::byte b : bytes.last(std::min<std::size_t>(4, bytes.size())))
    size = size >> 8U | std::to_integer<std::uint64_t>(b) << 24U;
  return size;
}

/// gzip pads with zeros on tapes and in blocks.
bool only_zeros(std::span<const std::byte> bytes) {
  return std::ranges::all_of(bytes, [](std::byte b) { return b == std::byte{0}; });
}

}  // namespace

bool is_gzip(std::span<const std::byte> bytes) {
  return bytes.size() >= 2 && std::to_integer<unsigned>(bytes[0]) == kZipMagic[0] &&
         std::to_integer<unsigned>(bytes[1]) == kZipMagic[1];
}

Status gunzip_pieces(const std::string& name, std::span<const std::byte> bytes,
                     const Progress& progress, const TakePiece& take) {
  z_stream stream{};
  constexpr int gzip_only = 16 + MAX_WBITS;
  if (inflateInit2(&stream, gzip_only) != Z_OK) {
    return make_error("{}: not enough memory to decompress it; decompress it with gunzip first",
                      name);
  }
  const std::unique_ptr<z_stream, EndInflate> end_inflate(&stream);

  std::vector<std::byte> piece(kPieceBytes);
  std::size_t used = 0;  // of bytes
  std::uint64_t unpacked = 0;
  const std::uint64_t most = std::max(kAnyRatioBytes, kLargestRatio * bytes.size());
  for (;;) {
    if (progress.cancelled()) return interrupted_error();
    stream.next_in = const_cast<Bytef*>(reinterpret_cast<const Bytef*>(bytes.data() + used));
    stream.avail_in = static_cast<uInt>(std::min(kStep, bytes.size() - used));
    stream.next_out = reinterpret_cast<Bytef*>(piece.data());
    stream.avail_out = static_cast<uInt>(piece.size());
    const uInt in_before = stream.avail_in;
    const int code = inflate(&stream, Z_NO_FLUSH);
    used += in_before - stream.avail_in;
    const auto made = std::span(piece).first(piece.size() - stream.avail_out);
    unpacked += made.size();
    if (unpacked > most) {
      return make_error(
          "{}: decompresses to more than {} times its size, which no scan should; decompress it "
          "with gunzip first if it is one",
          name, kLargestRatio);
    }
    RELIEF_TRY(take(made, used));
    if (code == Z_STREAM_END) {
      const auto left = bytes.subspan(used);
      if (only_zeros(left)) return {};
      if (!is_gzip(left)) {
        return make_error(
            "{}: byte {}: the compressed data is followed by something else; the file "
            "is damaged",
            name, used);
      }
      inflateReset(&stream);
    } else if (code == Z_MEM_ERROR) {
      return make_error("{}: not enough memory to decompress it; decompress it with gunzip first",
                        name);
    } else if (code != Z_OK && code != Z_BUF_ERROR) {
      return make_error("{}: byte {}: the compressed data is damaged ({})", name, used,
                        stream.msg != nullptr ? stream.msg : "not as gzip defines it");
    } else if (used == bytes.size() && stream.avail_out != 0) {
      return make_error("{}: the compressed data ends early; the file is truncated", name);
    }
  }
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
