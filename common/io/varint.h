// Variable-length integers (LEB128): seven bits a byte, lowest first; a set high bit means that
// more follow.
#pragma once

#include <cstdint>
#include <vector>

#include "common/io/bytes.h"

namespace relief {

template <class Byte>
void append_varint(std::vector<Byte>& out, std::uint64_t value) {
  for (; value >= 0x80; value >>= 7U) out.push_back(static_cast<Byte>((value & 0x7FU) | 0x80U));
  out.push_back(static_cast<Byte>(value));
}

/// Appends a signed number with zigzag coding: 0, -1, 1, -2 ... become 0, 1, 2, 3 ...
inline void append_signed(std::vector<std::byte>& out, std::int64_t value) {
  const auto bits = static_cast<std::uint64_t>(value);
  append_varint(out, value < 0 ? ~(bits << 1U) : bits << 1U);
}

/// Returns false if the bytes end within the number or it has more than 64 bits.
[[nodiscard]] inline bool take_varint(ByteReader& in, std::uint64_t& value) {
  value = 0;
  for (unsigned shift = 0; shift < 64; shift += 7) {
    if (in.left() == 0) return false;
    const auto byte = in.take<std::uint8_t>();
    value |= std::uint64_t{byte & 0x7FU} << shift;
    if ((byte & 0x80U) == 0) return true;
  }
  return false;
}

/// Inverse of append_signed.
[[nodiscard]] inline bool take_signed(ByteReader& in, std::int64_t& value) {
  std::uint64_t bits = 0;
  if (!take_varint(in, bits)) return false;
  value = static_cast<std::int64_t>((bits & 1U) != 0 ? ~(bits >> 1U) : bits >> 1U);
  return true;
}

}  // namespace relief
