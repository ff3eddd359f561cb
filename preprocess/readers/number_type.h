// Number types of binary files.
#pragma once

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace relief {

enum class NumberType : std::uint8_t {
  Int8,
  Uint8,
  Int16,
  Uint16,
  Int32,
  Uint32,
  Int64,
  Uint64,
  Float32,
  Float64
};

[[nodiscard]] constexpr std::size_t size_of(NumberType type) {
  constexpr std::size_t sizes[] = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  return sizes[static_cast<std::size_t>(type)];
}

[[nodiscard]] constexpr bool is_real(NumberType type) {
  return type >= NumberType::Float32;
}

namespace detail {
template <class Number, class Bits, bool BigEndian>
[[nodiscard]] Number load(const char* bytes) {
  Bits bits = 0;
  for (std::size_t i = 0; i < sizeof(Bits); ++i) {
    const std::size_t shift = 8 * (BigEndian ? sizeof(Bits) - 1 - i : i);
    bits = static_cast<Bits>(bits |
                             (static_cast<Bits>(static_cast<unsigned char>(bytes[i])) << shift));
  }
  return std::bit_cast<Number>(bits);
}
}  // namespace detail

/// Reads a little-endian unsigned integer.
template <std::integral Number>
[[nodiscard]] Number load_whole(const char* bytes) {
  return detail::load<Number, std::make_unsigned_t<Number>, false>(bytes);
}

/// Reads size_of(type) bytes. Only 64-bit integers above 2^53 are rounded.
template <bool BigEndian>
[[nodiscard]] double load_number(NumberType type, const char* bytes) {
  using namespace detail;
  switch (type) {
    case NumberType::Int8:
      return load<std::int8_t, std::uint8_t, BigEndian>(bytes);
    case NumberType::Uint8:
      return load<std::uint8_t, std::uint8_t, BigEndian>(bytes);
    case NumberType::Int16:
      return load<std::int16_t, std::uint16_t, BigEndian>(bytes);
    case NumberType::Uint16:
      return load<std::uint16_t, std::uint16_t, BigEndian>(bytes);
    case NumberType::Int32:
      return load<std::int32_t, std::uint32_t, BigEndian>(bytes);
    case NumberType::Uint32:
      return load<std::uint32_t, std::uint32_t, BigEndian>(bytes);
    case NumberType::Int64:
      return static_cast<double>(load<std::int64_t, std::uint64_t, BigEndian>(bytes));
    case NumberType::Uint64:
      return static_cast<double>(load<std::uint64_t, std::uint64_t, BigEndian>(bytes));
    case NumberType::Float32:
      return static_cast<double>(load<float, std::uint32_t, BigEndian>(bytes));
    case NumberType::Float64:
      return load<double, std::uint64_t, BigEndian>(bytes);
  }
  return 0.0;
}

}  // namespace relief
