// Border lengths between regions while they merge.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace relief {

/// The pairs of neighbours that form a border between two regions.
inline constexpr std::uint32_t kBorderNeighbours = 8;

/// The border lengths of a cluster by neighbour index. A sorted list, because a cluster has few
/// neighbours.
class Borders {
 public:
  struct Border {
    std::uint32_t other;
    double length;
  };

  [[nodiscard]] double length_to(std::uint32_t other) const {
    for (const Border& b : list_) {
      if (b.other == other) return b.length;
    }
    return 0.0;
  }

  double& operator[](std::uint32_t other) {
    const auto at = find_entry(other);
    if (at != list_.end() && at->other == other) return at->length;
    return list_.insert(at, {other, 0.0})->length;
  }

  void erase(std::uint32_t other) {
    const auto at = find_entry(other);
    if (at != list_.end() && at->other == other) list_.erase(at);
  }

  [[nodiscard]] auto begin() const { return list_.begin(); }
  [[nodiscard]] auto end() const { return list_.end(); }

 private:
  std::vector<Border>::iterator find_entry(std::uint32_t other) {
    return std::lower_bound(list_.begin(), list_.end(), other,
                            [](const Border& b, std::uint32_t o) { return b.other < o; });
  }

  std::vector<Border> list_;
};

}  // namespace relief
