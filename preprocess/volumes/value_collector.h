// Collects numbers from pieces of a file's bytes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "preprocess/volumes/number_form.h"

namespace relief {

/// Turns bytes into numbers as they arrive, so that unpacked bytes are never kept. Real: float or
/// double. As floats, infinities, and values that are too large for a float, become NaN.
template <class Real>
class ValueCollector {
 public:
  /// Expects `count` numbers. Reserves memory for `likely` of them, and then grows with the data.
  ValueCollector(NumberForm form, std::uint64_t count, std::uint64_t likely);

  /// Takes the next bytes; a piece may end within a number. Bytes beyond the last number are only
  /// counted.
  void take(std::span<const std::byte> piece);

  [[nodiscard]] bool is_complete() const { return values_.size() == count_; }
  /// Number of bytes that came after the last number.
  [[nodiscard]] std::uint64_t surplus() const { return surplus_; }
  /// Number of bytes of all whole numbers so far.
  [[nodiscard]] std::uint64_t taken() const { return values_.size() * size_of(form_.type); }
  /// Hands over the numbers. Nothing may be taken afterwards.
  [[nodiscard]] std::vector<Real> release() { return std::move(values_); }

 private:
  void convert(const std::byte* bytes, std::size_t numbers);

  NumberForm form_;
  std::uint64_t count_;
  std::vector<Real> values_;
  std::array<std::byte, 8> part_{};  ///< a number of which more bytes are to come
  std::size_t part_bytes_ = 0;
  std::uint64_t surplus_ = 0;
};

extern template class ValueCollector<float>;
extern template class ValueCollector<double>;

}  // namespace relief
