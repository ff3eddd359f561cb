// Little-endian numbers in byte strings, on machines of any byte order.
#pragma once

#include <bit>
#include <cassert>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

namespace relief {

namespace detail {
template <std::size_t Size>
using UnsignedOfSize = std::conditional_t<
    Size == 1, std::uint8_t,
    std::conditional_t<Size == 2, std::uint16_t,
                       std::conditional_t<Size == 4, std::uint32_t, std::uint64_t>>>;
}  // namespace detail

/// Appends `value` to `bytes`.
template <class Number>
requires std::integral<Number> || std::floating_point<Number>
void append_number(std::vector<std::byte>& bytes, Number value) {
  const auto bits = std::bit_cast<detail::UnsignedOfSize<sizeof(Number)>>(value);
  for (std::size_t i = 0; i < sizeof(Number); ++i) {
    bytes.push_back(static_cast<std::byte>((bits >> (8 * i)) & 0xFFU));
  }
}

/// Takes numbers from the front of a byte string. The caller checks `left()` first.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  [[nodiscard]] std::size_t left() const { return bytes_.size(); }

  template <class Number>
  requires std::integral<Number> || std::floating_point<Number>
  [[nodiscard]] Number take() {
    using Bits = detail::UnsignedOfSize<sizeof(Number)>;
    Bits bits = 0;
    const std::span<const std::byte> taken = take_bytes(sizeof(Number));
    for (std::size_t i = 0; i < sizeof(Number); ++i) {
      bits = static_cast<Bits>(bits | (std::to_integer<Bits>(taken[i]) << (8 * i)));
    }
    return std::bit_cast<Number>(bits);
  }

  [[nodiscard]] std::span<const std::byte> take_bytes(std::size_t count) {
    assert(count <= bytes_.size() && "the caller checks left() first");
    const std::span<const std::byte> taken = bytes_.first(count);
    bytes_ = bytes_.subspan(count);
    return taken;
  }

 private:
  std::span<const std::byte> bytes_;
};

}  // namespace relief
