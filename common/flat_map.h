// A hash map that is read far more often than written.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace relief {

/// Numbers by 64-bit keys, in one table with open addressing: a look-up mostly reads one cache
/// line, where std::unordered_map reads three.
class FlatMap {
 public:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  /// `expected`: about how many keys there will be.
  explicit FlatMap(std::size_t expected = 0) : slots_(std::bit_ceil(2 * expected + 2)) {}

  /// Returns the number of a key, or kNone.
  [[nodiscard]] std::uint32_t find(std::uint64_t key) const { return slots_[slot_of(key)].number; }

  /// Adds a key unless it is there. `number`: not kNone. Returns the key's number.
  std::uint32_t insert(std::uint64_t key, std::uint32_t number) {
    Slot& slot = slots_[slot_of(key)];
    if (slot.number != kNone) return slot.number;
    slot = {key, number};
    if (2 * ++size_ >= slots_.size()) grow();
    return number;
  }

 private:
  struct Slot {
    std::uint64_t key = 0;
    std::uint32_t number = kNone;
  };

  /// Where a key is, or would be.
  [[nodiscard]] std::size_t slot_of(std::uint64_t key) const {
    std::uint64_t hash = (key ^ (key >> 32U)) * 0x9e3779b97f4a7c15U;  // 2^64 / the golden ratio
    hash ^= hash >> 32U;
    std::size_t k = hash & (slots_.size() - 1);
    while (slots_[k].number != kNone && slots_[k].key != key) k = (k + 1) & (slots_.size() - 1);
    return k;
  }

  void grow() {
    std::vector<Slot> old(2 * slots_.size());
    old.swap(slots_);
    for (const Slot& slot : old) {
      if (slot.number != kNone) slots_[slot_of(slot.key)] = slot;
    }
  }

  std::vector<Slot> slots_;
  std::size_t size_ = 0;
};

}  // namespace relief
