#include "common/residuals.h"

#include <zstd.h>

#include <algorithm>
#include <cassert>

namespace relief {
namespace {

/// Higher levels search longer for repetitions, of which residuals have none.
constexpr int kZstdLevel = 9;

Result<std::vector<std::uint8_t>> decompress(std::span<const std::byte> frame, std::size_t size,
                                             ZstdContexts& zstd) {
  std::vector<std::uint8_t> bytes(size);
  const std::size_t decoded =
      ZSTD_decompressDCtx(zstd.decompression(), bytes.data(), size, frame.data(), frame.size());
  if (ZSTD_isError(decoded) != 0U || decoded != size) {
    return make_error("a zstd stream is damaged");
  }
  return bytes;
}

/// The next frame; empty for a stream of zeros.
Result<std::span<const std::byte>> take_frame(ByteReader& in) {
  if (in.left() < 4) return make_error("a stream is missing");
  const auto size = in.take<std::uint32_t>();
  if (size > in.left()) {
    return make_error("a stream of {} bytes is announced where {} are left", size, in.left());
  }
  return in.take_bytes(size);
}

}  // namespace

void append_stream(std::vector<std::byte>& out, std::span<const std::uint8_t> bytes,
                   ZstdContexts& zstd) {
  const bool zero = std::all_of(bytes.begin(), bytes.end(), [](std::uint8_t b) { return b == 0; });
  append_sized_stream(out, zero ? std::span<const std::uint8_t>() : bytes, zstd);
}

void append_sized_stream(std::vector<std::byte>& out, std::span<const std::uint8_t> bytes,
                         ZstdContexts& zstd) {
  if (bytes.empty()) {
    append_number(out, std::uint32_t{0});
    return;
  }
  std::vector<std::byte> frame(ZSTD_compressBound(bytes.size()));
  const std::size_t size = ZSTD_compressCCtx(zstd.compression(), frame.data(), frame.size(),
                                             bytes.data(), bytes.size(), kZstdLevel);
  assert(ZSTD_isError(size) == 0U && "the buffer has the size that zstd asks for");
  append_number(out, static_cast<std::uint32_t>(size));
  out.insert(out.end(), frame.begin(), frame.begin() + static_cast<std::ptrdiff_t>(size));
}

Result<std::vector<std::uint8_t>> take_stream(ByteReader& in, std::size_t decoded_size,
                                              ZstdContexts& zstd) {
  const auto frame = take_frame(in);
  if (!frame) return frame.error();
  if (frame->empty()) return std::vector<std::uint8_t>(decoded_size, 0);
  // A frame may leave its size out; codec 1 does not.
  if (ZSTD_getFrameContentSize(frame->data(), frame->size()) != decoded_size) {
    return make_error("a stream does not decode to the {} bytes that belong there", decoded_size);
  }
  return decompress(*frame, decoded_size, zstd);
}

Result<std::vector<std::uint8_t>> take_sized_stream(ByteReader& in, std::size_t largest,
                                                    ZstdContexts& zstd) {
  const auto frame = take_frame(in);
  if (!frame) return frame.error();
  if (frame->empty()) return std::vector<std::uint8_t>();
  // ZSTD_CONTENTSIZE_UNKNOWN and _ERROR are the two largest numbers.
  const unsigned long long size = ZSTD_getFrameContentSize(frame->data(), frame->size());
  if (size > largest) return make_error("a stream decodes to more than {} bytes", largest);
  return decompress(*frame, static_cast<std::size_t>(size), zstd);
}

void append_residuals(std::vector<std::byte>& out, std::span<const std::uint16_t> residuals,
                      ZstdContexts& zstd) {
  std::vector<std::uint8_t> plane(residuals.size());
  for (const unsigned shift : {0U, 8U}) {
    std::transform(residuals.begin(), residuals.end(), plane.begin(), [shift](std::uint16_t r) {
      return static_cast<std::uint8_t>((r >> shift) & 0xFFU);
    });
    append_stream(out, plane, zstd);
  }
}

Result<std::vector<std::uint16_t>> take_residuals(ByteReader& in, std::size_t count,
                                                  ZstdContexts& zstd) {
  const auto low = take_stream(in, count, zstd);
  if (!low) return low.error();
  const auto high = take_stream(in, count, zstd);
  if (!high) return high.error();
  std::vector<std::uint16_t> residuals(count);
  std::transform(low->begin(), low->end(), high->begin(), residuals.begin(),
                 [](std::uint8_t l, std::uint8_t h) {
                   return static_cast<std::uint16_t>(l | (std::uint32_t{h} << 8U));
                 });
  return residuals;
}

Status check_end(const ByteReader& in) {
  if (in.left() > 0) return make_error("{} bytes are left after the last stream", in.left());
  return {};
}

}  // namespace relief
