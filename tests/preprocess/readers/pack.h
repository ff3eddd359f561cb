// Numbers as bytes.
#pragma once

#include <bit>
#include <cstring>
#include <string>

namespace relief::test {

enum class ByteOrder { Little, Big };

/// The bytes of numbers, one after the other.
template <class... Numbers>
std::string pack(ByteOrder order, Numbers... numbers) {
  std::string bytes;
  const auto append = [&](auto number) {
    std::string one(sizeof(number), '\0');
    std::memcpy(one.data(), &number, sizeof(number));
    const bool native =
        (std::endian::native == std::endian::little) == (order == ByteOrder::Little);
    bytes += native ? one : std::string(one.rbegin(), one.rend());
  };
  (append(numbers), ...);
  return bytes;
}

template <class... Numbers>
std::string pack(Numbers... numbers) {
  return pack(ByteOrder::Little, numbers...);
}

}  // namespace relief::test
