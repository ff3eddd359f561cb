// A bounded sample of a series whose length is not known.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace relief {

/// What chance has chosen of a series, spread over all of it: every n-th point would lie in the
/// scanner's lines. The same for the same series. All of a series of fewer than `Most`; of longer
/// ones at least about half as many.
template <class T, std::size_t Most = std::size_t{1} << 18U>
class ChanceSample {
 public:
  static constexpr std::size_t kMost = Most;

  void add(const T& value) {
    const std::uint64_t lot = lot_of(seen_++);
    if ((lot & mask_) != 0) return;
    chosen_.push_back({lot, value});
    if (chosen_.size() < kMost) return;
    mask_ = mask_ << 1U | 1U;
    std::erase_if(chosen_, [this](const Chosen& c) { return (c.lot & mask_) != 0; });
  }

  [[nodiscard]] std::vector<T> take() {
    std::vector<T> values;
    values.reserve(chosen_.size());
    for (const Chosen& c : chosen_) values.push_back(c.value);
    chosen_ = {};
    return values;
  }

 private:
  struct Chosen {
    std::uint64_t lot = 0;
    T value{};
  };

  /// The n-th of a series of numbers that look random (splitmix64).
  static std::uint64_t lot_of(std::uint64_t n) {
    std::uint64_t z = (n + 1) * 0x9E3779B97F4A7C15U;
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
    return z ^ (z >> 31U);
  }

  std::vector<Chosen> chosen_;
  std::uint64_t seen_ = 0;
  std::uint64_t mask_ = 0;  ///< values are chosen whose lot has none of these bits
};

}  // namespace relief
