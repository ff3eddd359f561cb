// Entropy coding for codec 2 of the patch file: range asymmetric numeral systems (Duda, "Asymmetric
// numeral systems", arXiv:1311.2540, 2013), one 32-bit state, 16-bit words (docs/patch-file.md,
// "Codec 2"). Each symbol is an interval of 0..4095, as wide as the symbol is probable.
#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace relief {

inline constexpr unsigned kProbabilityBits = 12;
inline constexpr std::uint32_t kProbabilityOne = 1U << kProbabilityBits;
/// The lowest state; states reach up to 2^32 - 1. Coding starts and decoding ends with this one.
inline constexpr std::uint32_t kMinState = 1U << 16U;
/// The largest number of equally probable bits in one interval.
inline constexpr unsigned kMaxRawBits = kProbabilityBits;

/// The interval of 0..4095 of a symbol.
struct Interval {
  std::uint16_t start = 0;
  std::uint16_t width = 0;  ///< 1 to 4095, or 4096 if certain
};

/// Collects intervals in the order of decoding.
class RansEncoder {
 public:
  void put(Interval interval) {
    assert(interval.width > 0 && interval.start + interval.width <= kProbabilityOne);
    intervals_.push_back(interval);
  }

  /// Adds `count` equally probable bits, at most 16.
  void put_bits(std::uint32_t value, unsigned count) {
    assert(count <= 16 && value >> count == 0);
    if (count > kMaxRawBits) {
      put_bits(value & 0xFFU, 8);
      put_bits(value >> 8U, count - 8);
      return;
    }
    const std::uint32_t width = kProbabilityOne >> count;
    put({static_cast<std::uint16_t>(value * width), static_cast<std::uint16_t>(width)});
  }

  /// Appends the state and the words, both little-endian.
  void finish(std::vector<std::byte>& out) const;

 private:
  std::vector<Interval> intervals_;
};

/// Decodes symbols from hostile bytes: past their end it reads zeros, and `is_sound` becomes false.
class RansDecoder {
 public:
  explicit RansDecoder(std::span<const std::byte> bytes) : bytes_(bytes) {
    for (const unsigned shift : {0U, 16U}) {
      state_ |= word() << shift;
      at_ += 2;
    }
  }

  /// Returns the number to look up in the symbols' intervals.
  [[nodiscard]] std::uint32_t peek() const { return state_ & (kProbabilityOne - 1); }

  /// Removes a symbol, whose interval held peek().
  void advance(Interval interval) {
    step(interval);
    if (state_ < kMinState) {
      state_ = state_ << 16U | word();
      at_ += 2;
    }
  }

  /// `advance` without a branch on reading a word. For symbols of a few bits that branch is
  /// mispredicted too often (a twentieth of the time of decoding heights). For cheaper symbols, as
  /// in masks, `advance` is faster.
  void advance_evenly(Interval interval) {
    step(interval);
    const std::uint32_t reads = state_ < kMinState ? 1 : 0;
    state_ = state_ << (16 * reads) | (word() & (0U - reads));
    at_ += std::size_t{2} * reads;
  }

  std::uint32_t take_bits(unsigned count) {
    if (count <= kMaxRawBits) return take_raw(count);
    const std::uint32_t low = take_raw(8);
    return low | take_raw(count - 8) << 8U;
  }

  /// Returns whether nothing was read past the end.
  [[nodiscard]] bool is_sound() const { return at_ <= bytes_.size(); }

  /// Returns whether all bytes were read and the state is an encoder's first.
  [[nodiscard]] bool is_at_end() const { return at_ == bytes_.size() && state_ == kMinState; }

 private:
  std::uint32_t take_raw(unsigned count) {
    const unsigned shift = kProbabilityBits - count;
    const std::uint32_t value = peek() >> shift;
    advance({static_cast<std::uint16_t>(value << shift), static_cast<std::uint16_t>(1U << shift)});
    return value;
  }

  void step(Interval interval) {
    state_ = interval.width * (state_ >> kProbabilityBits) + (peek() - interval.start);
  }

  /// The next word to read.
  [[nodiscard]] std::uint32_t word() const {
    static constexpr std::array<std::byte, 2> kNone{};
    const std::byte* const from = at_ + 2 <= bytes_.size() ? bytes_.data() + at_ : kNone.data();
    return std::to_integer<std::uint32_t>(from[0]) | std::to_integer<std::uint32_t>(from[1]) << 8U;
  }

  std::span<const std::byte> bytes_;
  std::size_t at_ = 0;
  std::uint32_t state_ = 0;
};

}  // namespace relief
