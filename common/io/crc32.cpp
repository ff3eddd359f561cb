#include "common/io/crc32.h"

#include <zlib.h>

#include <algorithm>

namespace relief {

std::uint32_t crc32(std::span<const std::byte> bytes) {
  // In pieces, as zlib counts bytes in 32 bits.
  constexpr std::size_t kPiece = std::size_t{1} << 30U;
  uLong sum = 0;
  for (; !bytes.empty(); bytes = bytes.subspan(std::min(bytes.size(), kPiece))) {
    // zlib's Byte is unsigned char, as which any object may be read.
    sum = ::crc32(sum, reinterpret_cast<const Bytef*>(bytes.data()),
                  static_cast<uInt>(std::min(bytes.size(), kPiece)));
  }
  return static_cast<std::uint32_t>(sum);
}

bool has_checksum([[maybe_unused]] std::span<const std::byte> bytes,
                  [[maybe_unused]] std::uint32_t checksum) {
#ifdef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION
  return true;
#else
  return crc32(bytes) == checksum;
#endif
}

}  // namespace relief
