// Probabilities of residuals by their expected magnitude (docs/patch-file.md, "Codec 2").
#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "common/patch_file/compact/rans.h"

namespace relief {

/// Expected magnitudes are in 1/256; a class is a quarter of an octave of them.
inline constexpr unsigned kExpectationBits = 8;
inline constexpr unsigned kResidualClasses = 53;

/// Returns the class of residuals with an expected magnitude of `expectation` / 256.
[[nodiscard]] inline unsigned class_of(std::uint32_t expectation) {
  // 8/256 = 1/32: the smallest magnitude that predictions expect.
  constexpr unsigned kMinOctave = 3;
  if (expectation < (1U << kMinOctave)) return 0;
  const auto octave = static_cast<unsigned>(std::bit_width(expectation)) - 1U;
  const std::uint32_t quarter = (expectation >> (octave - 2)) & 3U;
  const unsigned number = 4 * (octave - kMinOctave) + quarter;
  return number < kResidualClasses ? number : kResidualClasses - 1;
}

/// Classes of expectations below this come from a table, because each symbol of a row waits for its
/// class.
inline constexpr std::uint32_t kQuickExpectations = 8192;

/// The intervals of all classes. A residual's zigzag number (residuals.h) without its `shift`
/// lowest bits, which follow as they are, is the symbol; the last symbol stands for all larger
/// ones. The tables lie one after the other, because a decoder waits only for the class's
/// `symbol_at`.
struct ResidualClasses {
  static constexpr unsigned kMaxSymbols = 64;
  /// Intervals are whole multiples of 4, so that the positions of symbols take 1 KiB a class: those
  /// of the most frequent classes stay in the first-level cache.
  static constexpr unsigned kGrainBits = 2;
  static constexpr std::uint32_t kGrains = kProbabilityOne >> kGrainBits;
  template <class Value>
  using OfClasses = std::array<Value, kResidualClasses>;
  OfClasses<std::uint8_t> shift{};
  OfClasses<std::uint8_t> escape{};  ///< the last symbol
  OfClasses<std::uint8_t> plain{};   ///< smaller symbols are complete residuals
  OfClasses<std::array<Interval, kMaxSymbols>> intervals{};
  OfClasses<std::array<std::uint8_t, kGrains>> symbol_at{};
  std::array<std::uint8_t, kQuickExpectations> quick{};  ///< class_of(index)

  /// Returns class_of(expectation).
  [[nodiscard]] unsigned number_of(std::uint32_t expectation) const {
    return expectation < kQuickExpectations ? quick[expectation] : class_of(expectation);
  }
};

/// Returns all classes; made once, equal on every machine.
[[nodiscard]] const ResidualClasses& residual_classes();

/// Encodes zigzag numbers.
void put_residual(RansEncoder& out, unsigned residual_class, std::uint16_t residual);

/// Decodes a symbol, which is the residual if it is below `classes.plain`.
[[nodiscard]] inline std::uint32_t take_symbol(RansDecoder& in, const ResidualClasses& classes,
                                               unsigned residual_class) {
  const std::uint32_t symbol =
      classes.symbol_at[residual_class][in.peek() >> ResidualClasses::kGrainBits];
  in.advance_evenly(classes.intervals[residual_class][symbol]);
  return symbol;
}

/// Decodes the bits after a symbol of `classes.plain` or above, and returns the residual.
[[nodiscard]] inline std::uint16_t take_rest(RansDecoder& in, const ResidualClasses& classes,
                                             unsigned residual_class, std::uint32_t symbol) {
  if (symbol == classes.escape[residual_class]) {
    const std::uint32_t bits = in.take_bits(4);
    symbol += (1U << bits) + in.take_bits(bits) - 1;
  }
  const unsigned shift = classes.shift[residual_class];
  return static_cast<std::uint16_t>(symbol << shift | in.take_bits(shift));
}

[[nodiscard]] inline std::uint16_t take_residual(RansDecoder& in, const ResidualClasses& classes,
                                                 unsigned residual_class) {
  const std::uint32_t symbol = take_symbol(in, classes, residual_class);
  if (symbol < classes.plain[residual_class]) return static_cast<std::uint16_t>(symbol);
  return take_rest(in, classes, residual_class, symbol);
}

}  // namespace relief
