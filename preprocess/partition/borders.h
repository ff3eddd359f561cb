// How long the borders of a region with its neighbours are, while regions merge.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace relief {

/// The neighbours that make a border between two regions.
inline constexpr std::uint32_t kBorderNeighbours = 8;

/// The lengths of a cluster's borders with its neighbours: few, so a list does, by their numbers.
class Borders {
 public:
  struct Border {
    std::uint32_t other;
    double length;
  };

  double& operator[](std::uint32_t other) {
    const auto at = place_of(other);
    if (at != list_.end() && at->other == other) return at->length;
    return list_.insert(at, {other, 0.0})->length;
  }

  void erase(std::uint32_t other) {
    const auto at = place_of(other);
    if (at != list_.end() && at->other == other) list_.erase(at);
  }

  [[nodiscard]] auto begin() const { return list_.begin(); }
  [[nodiscard]] auto end() const { return list_.end(); }

 private:
  std::vector<Border>::iterator place_of(std::uint32_t other) {
    return std::lower_bound(list_.begin(), list_.end(), other,
                            [](const Border& b, std::uint32_t o) { return b.other < o; });
  }

  std::vector<Border> list_;
};

}  // namespace relief
