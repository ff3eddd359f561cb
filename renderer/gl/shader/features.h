// The key of a shader variant. The bits and their costs: shaders/include/shared.h.
#pragma once

#include <cstdint>
#include <tuple>

#include "shaders/include/shared.h"

namespace relief {

/// Two words: the RELIEF_FEATURE bits, and the number of lights. Shaders see them as the macros
/// RELIEF_FEATURES and RELIEF_LIGHTS.
struct Features {
  std::uint32_t bits = 0;
  std::uint32_t lights = 0;  ///< of lit materials, else 0

  constexpr Features() = default;
  constexpr Features(std::uint32_t b, std::uint32_t l = 0)  // NOLINT: implicit on purpose
      : bits(b), lights(l) {}

  /// Whether it has any of these bits.
  [[nodiscard]] constexpr bool has(std::uint32_t any) const { return (bits & any) != 0; }
  [[nodiscard]] constexpr Features without(std::uint32_t less) const {
    return {bits & ~less, lights};
  }
  /// These bits, and no lights.
  [[nodiscard]] constexpr Features only(std::uint32_t kept) const { return {bits & kept}; }
  constexpr Features& operator|=(std::uint32_t more) {
    bits |= more;
    return *this;
  }

  bool operator==(const Features&) const = default;
  [[nodiscard]] bool operator<(const Features& other) const {
    return std::tie(bits, lights) < std::tie(other.bits, other.lights);
  }
};

[[nodiscard]] constexpr Features operator|(Features features, std::uint32_t more) {
  return features |= more;
}

/// Why no image can have these features together, as a clause; null if it can. The one list of what
/// does not go together: each variant of an engine is checked against it (VariantCache).
[[nodiscard]] const char* contradiction_in(Features features);

}  // namespace relief
