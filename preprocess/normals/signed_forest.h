// Connected components with relative orientation.
#pragma once

#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace relief {

/// Union-find whose links carry whether the child's normal is flipped relative to its parent's.
class SignedForest {
 public:
  explicit SignedForest(std::size_t n) : parent_(n), flipped_(n, 0), size_(n, 1) {
    std::iota(parent_.begin(), parent_.end(), 0U);
  }

  struct Root {
    std::uint32_t root;
    bool flipped;  // relative to the root
  };

  Root find(std::uint32_t i) {
    // Two passes: find the root and the sign, then attach every node to it.
    std::uint32_t root = i;
    bool flipped = false;
    while (parent_[root] != root) {
      flipped ^= flipped_[root] != 0;
      root = parent_[root];
    }
    bool sign = flipped;
    while (parent_[i] != root && parent_[i] != i) {
      const std::uint32_t next = parent_[i];
      const bool own = flipped_[i] != 0;
      parent_[i] = root;
      flipped_[i] = sign ? 1 : 0;
      sign ^= own;
      i = next;
    }
    return {root, flipped};
  }

  /// The number of members of a root's component.
  [[nodiscard]] std::uint32_t size(Root root) const { return size_[root.root]; }

  void join(Root a, Root b, bool flip_between) {
    if (size_[a.root] < size_[b.root]) std::swap(a, b);
    parent_[b.root] = a.root;
    flipped_[b.root] = (a.flipped ^ b.flipped ^ flip_between) ? 1 : 0;
    size_[a.root] += size_[b.root];
  }

 private:
  std::vector<std::uint32_t> parent_;
  std::vector<std::uint8_t> flipped_;
  std::vector<std::uint32_t> size_;
};

}  // namespace relief
