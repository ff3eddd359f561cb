#include "preprocess/readers/gzip/inflate.h"

#include <zlib.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "common/guard.h"

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

/// gzip pads with zeros on tapes and in blocks.
bool only_zeros(std::span<const std::byte> bytes) {
  return std::ranges::all_of(bytes, [](std::byte b) { return b == std::byte{0}; });
}

/// As zlib's inflateInit2 wants them.
int window_bits(DeflateForm form) {
  switch (form) {
    case DeflateForm::Gzip:
      return 16 + MAX_WBITS;
    case DeflateForm::Zlib:
      return MAX_WBITS;
    case DeflateForm::Raw:
      return -MAX_WBITS;
  }
  return MAX_WBITS;
}

}  // namespace

bool is_gzip(std::span<const std::byte> bytes) {
  return bytes.size() >= 2 && std::to_integer<unsigned>(bytes[0]) == kZipMagic[0] &&
         std::to_integer<unsigned>(bytes[1]) == kZipMagic[1];
}

Status inflate_pieces(const std::string& name, std::span<const std::byte> bytes, DeflateForm form,
                      const Progress& progress, const TakeInflated& take) {
  z_stream stream{};
  if (inflateInit2(&stream, window_bits(form)) != Z_OK) {
    return make_error("{}: not enough memory to decompress it; {}", name, kMoreMemory);
  }
  const std::unique_ptr<z_stream, EndInflate> end_inflate(&stream);

  std::vector<std::byte> piece(kPieceBytes);
  std::size_t used = 0;  // of bytes
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
    RELIEF_TRY_ASSIGN(const bool goes_on, take(made, used));
    if (!goes_on) return {};
    if (code == Z_STREAM_END) {
      if (form != DeflateForm::Gzip) return {};
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
      return make_error("{}: not enough memory to decompress it; {}", name, kMoreMemory);
    } else if (code != Z_OK && code != Z_BUF_ERROR) {
      return make_error("{}: byte {}: the compressed data is damaged ({})", name, used,
                        stream.msg != nullptr ? stream.msg : "not as DEFLATE defines it");
    } else if (used == bytes.size() && stream.avail_out != 0) {
      return make_error("{}: the compressed data ends early; the file is truncated", name);
    }
  }
}

}  // namespace relief
