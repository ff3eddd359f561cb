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

/// A pair of neighbouring clusters, and what they were when its cost was told.
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

/// Candidates, best first. Nine of ten are void before their turn (on the Dragon 520,000 of
/// 579,000): they lie unsorted with those that cost about the same until it is the turn of these,
/// and are left out then.
class CandidateQueue {
 public:
  void push(const Candidate& candidate) {
    const std::size_t bucket = bucket_of(candidate.cost);
    if (bucket >= next_) return buckets_[bucket].push_back(candidate);
    heap_.push_back(candidate);
    std::push_heap(heap_.begin(), heap_.end(), worse);
  }

  /// The best of those that `is_current`, which stay so long as nothing merges; null if there is
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

  /// Takes the best one away.
  void pop() {
    std::pop_heap(heap_.begin(), heap_.end(), worse);
    heap_.pop_back();
  }

 private:
  static bool worse(const Candidate& a, const Candidate& b) { return a.is_worse_than(b); }

  // By exponent and seven bits of the mantissa: costs of the first merges are a hundredth of those
  // of the last ones.
  static constexpr unsigned kCutBits = 16;
  static constexpr float kLeastCost = 1.0F / 4096.0F;
  static constexpr float kMostCost = 16.0F;
  static constexpr std::uint32_t place_of(float cost) {
    return std::bit_cast<std::uint32_t>(cost) >> kCutBits;
  }
  static std::size_t bucket_of(double cost) {
    // What is no number goes to the last one.
    const float within =
        cost < kMostCost ? std::max(static_cast<float>(cost), kLeastCost) : kMostCost;
    return place_of(within) - place_of(kLeastCost);
  }

  std::vector<std::vector<Candidate>> buckets_{place_of(kMostCost) - place_of(kLeastCost) + 1};
  std::size_t next_ = 0;         // buckets before it are in the heap
  std::vector<Candidate> heap_;  // the best first
};

}  // namespace relief
