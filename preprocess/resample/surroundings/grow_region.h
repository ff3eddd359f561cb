// Grows outward from a region through the neighbour graph.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "common/neighbours/neighbours.h"
#include "preprocess/partition/region.h"

namespace relief {

/// A set of points. Open addressing, at most half full.
class PointSet {
 public:
  [[nodiscard]] bool has(std::uint32_t point) const { return slots_[slot_of(point)] == point; }

  void add(std::uint32_t point) {
    slots_[slot_of(point)] = point;
    if (2 * ++count_ <= slots_.size()) return;
    std::vector<std::uint32_t> old(2 * slots_.size(), kEmpty);
    old.swap(slots_);
    for (const std::uint32_t p : old) {
      if (p != kEmpty) slots_[slot_of(p)] = p;
    }
  }

 private:
  static constexpr std::uint32_t kEmpty = std::numeric_limits<std::uint32_t>::max();

  /// Returns the slot of a point, or the free slot for it.
  [[nodiscard]] std::size_t slot_of(std::uint32_t point) const {
    const std::size_t mask = slots_.size() - 1;
    std::size_t slot = (point * 0x9E3779B97F4A7C15ULL >> 32U) & mask;
    while (slots_[slot] != kEmpty && slots_[slot] != point) slot = (slot + 1) & mask;
    return slot;
  }

  std::vector<std::uint32_t> slots_ = std::vector<std::uint32_t>(1024, kEmpty);
  std::size_t count_ = 0;
};

/// Appends to `ids` the points of other regions that are reached from a region's own. Each reached
/// point remembers the region's point from which it was reached: `accepts(from, i, j)` says whether
/// the step from `i` to its neighbour `j` may be taken. `region_of`: of each point.
template <class Accepts>
void grow_region(const NeighbourGraph& graph, const Region& region,
                 const std::vector<std::uint32_t>& region_of, const Accepts& accepts,
                 std::vector<std::uint32_t>& ids) {
  struct Reached {
    std::uint32_t point;
    std::uint32_t from;
  };
  const std::uint32_t own = region_of[region.points.front()];
  PointSet seen;
  std::vector<Reached> front;
  front.reserve(region.points.size());
  for (const std::uint32_t i : region.points) front.push_back({i, i});
  while (!front.empty()) {
    std::vector<Reached> next;
    for (const auto [i, from] : front) {
      for (const std::uint32_t j : graph.of(i)) {
        if (region_of[j] == own || seen.has(j) || !accepts(from, i, j)) continue;
        seen.add(j);
        next.push_back({j, from});
        ids.push_back(j);
      }
    }
    front = std::move(next);
  }
}

}  // namespace relief
