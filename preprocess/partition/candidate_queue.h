// Pairs of clusters that may merge, best first.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

namespace relief {

/// A pair of neighbouring clusters, and their versions when its cost was computed.
struct Candidate {
  double cost;
  std::uint32_t a;
  std::uint32_t b;
  std::uint32_t version_a;
  std::uint32_t version_b;

  [[nodiscard]] bool is_worse_than(const Candidate& o) const {
    if (cost != o.cost) return cost > o.cost;
    return a != o.a ? a > o.a : b > o.b;
  }
};

/// A priority queue of candidates. Nine of ten become void before their turn (on the Dragon 520,000
/// of 579,000), so candidates stay in unsorted buckets of similar cost. A bucket is sorted, without
/// its void candidates, when its turn comes.
class CandidateQueue {
 public:
  void push(const Candidate& candidate) {
    const std::size_t bucket = bucket_of(candidate.cost);
    if (bucket >= next_) return buckets_[bucket].push_back(candidate);
    heap_.push_back(candidate);
    std::push_heap(heap_.begin(), heap_.end(), worse);
  }

  /// Returns the best candidate that `is_current`, valid until the next merge; null if there is
  /// none.
  template <class IsCurrent>
  [[nodiscard]] const Candidate* best(const IsCurrent& is_current) {
    for (;;) {
      while (!heap_.empty() && !is_current(heap_.front())) pop();
      if (!heap_.empty()) return &heap_.front();
      if (next_ == buckets_.size()) return nullptr;
      std::vector<Candidate> bucket = std::move(buckets_[next_++]);
      std::ranges::copy_if(bucket, std::back_inserter(heap_), is_current);
      std::make_heap(heap_.begin(), heap_.end(), worse);
    }
  }

  /// Removes the best candidate.
  void pop() {
    std::pop_heap(heap_.begin(), heap_.end(), worse);
    heap_.pop_back();
  }

 private:
  static bool worse(const Candidate& a, const Candidate& b) { return a.is_worse_than(b); }

  // Buckets by exponent and seven bits of the mantissa: costs of the first merges are a hundredth
  // of those of the last.
  static constexpr unsigned kCutBits = 16;
  static constexpr float kMinCost = 1.0F / 4096.0F;
  static constexpr float kMaxCost = 16.0F;
  static constexpr std::uint32_t bucket_of(float cost) {
    return std::bit_cast<std::uint32_t>(cost) >> kCutBits;
  }
  static std::size_t bucket_of(double cost) {
    // NaN goes to the last bucket.
    const float within = cost < kMaxCost ? std::max(static_cast<float>(cost), kMinCost) : kMaxCost;
    return bucket_of(within) - bucket_of(kMinCost);
  }

  std::vector<std::vector<Candidate>> buckets_{bucket_of(kMaxCost) - bucket_of(kMinCost) + 1};
  std::size_t next_ = 0;         // buckets before it are in the heap
  std::vector<Candidate> heap_;  // best first
};

}  // namespace relief
