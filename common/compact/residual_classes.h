// How probable residuals are, by how large they are expected to be (docs/patch-file.md, "Codec 2").
#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "common/compact/rans.h"

namespace relief {

/// Expected magnitudes are in 1/256; a class is a quarter of an octave of them.
inline constexpr unsigned kExpectationBits = 8;
inline constexpr unsigned kResidualClasses = 53;

/// The class of residuals whose magnitude is expected to be `expectation` / 256.
[[nodiscard]] inline unsigned class_of(std::uint32_t expectation) {
  // From 1/32 on: less than that the most certain prediction does not expect.
  constexpr unsigned kLeastOctave = 3;
  if (expectation < (1U << kLeastOctave)) return 0;
  const auto octave = static_cast<unsigned>(std::bit_width(expectation)) - 1U;
  const std::uint32_t quarter = (expectation >> (octave - 2)) & 3U;
  const unsigned number = 4 * (octave - kLeastOctave) + quarter;
  return number < kResidualClasses ? number : kResidualClasses - 1;
}

/// The intervals of one class. A residual's zigzag number (residuals.h) without its `shift` lowest
/// bits, which follow as they are, is the symbol; the last symbol stands for all larger ones.
struct ResidualClass {
  static constexpr unsigned kMostSymbols = 64;
  /// Intervals are whole multiples of 4, so that where symbols are takes 1 KiB a class: those of
  /// the most frequent classes stay in a core's first cache.
  static constexpr unsigned kGrainBits = 2;
  static constexpr std::uint32_t kGrains = kProbabilityOne >> kGrainBits;
  std::uint8_t shift = 0;
  std::uint8_t symbols = 0;  ///< the last of them is the escape
  std::array<Interval, kMostSymbols> intervals{};
  std::array<std::uint8_t, kGrains> symbol_at{};
};

/// All classes; made once, the same on every machine.
[[nodiscard]] const std::array<ResidualClass, kResidualClasses>& residual_classes();

/// Codes zigzag numbers.
void put_residual(RansEncoder& out, unsigned residual_class, std::uint16_t residual);

/// An escaped number, less the escape.
[[nodiscard]] inline std::uint32_t take_escaped(RansDecoder& in) {
  const std::uint32_t bits = in.take_bits(4);
  return (1U << bits) + in.take_bits(bits) - 1;
}

[[nodiscard]] inline std::uint16_t take_residual(RansDecoder& in, const ResidualClass& c) {
  std::uint32_t symbol = c.symbol_at[in.peek() >> ResidualClass::kGrainBits];
  in.advance(c.intervals[symbol]);
  if (symbol + 1 == c.symbols) [[unlikely]]
    symbol += take_escaped(in);
  if (c.shift == 0) return static_cast<std::uint16_t>(symbol);
  return static_cast<std::uint16_t>(symbol << c.shift | in.take_bits(c.shift));
}

}  // namespace relief
