// Sets that are joined and never split (Tarjan 1975).
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace relief {

/// Numbers from 0 on, at first each a set of its own.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : root_(count), size_(count, 1) {
    std::iota(root_.begin(), root_.end(), 0U);
  }

  /// The member that stands for a number's set.
  [[nodiscard]] std::uint32_t find(std::uint32_t number) {
    while (root_[number] != number) number = root_[number] = root_[root_[number]];
    return number;
  }

  /// How many members a number's set has.
  [[nodiscard]] std::size_t size(std::uint32_t number) { return size_[find(number)]; }

  void join(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    if (a == b) return;
    if (size_[a] < size_[b]) std::swap(a, b);
    root_[b] = a;
    size_[a] += size_[b];
  }

 private:
  std::vector<std::uint32_t> root_;
  std::vector<std::size_t> size_;
};

}  // namespace relief
