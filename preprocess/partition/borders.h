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

  /// 0 if there is no border.
  [[nodiscard]] double length_to(std::uint32_t other) const {
    const auto at = std::lower_bound(list_.begin(), list_.end(), other, is_before);
    return at != list_.end() && at->other == other ? at->length : 0.0;
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
  static bool is_before(const Border& border, std::uint32_t other) { return border.other < other; }

  std::vector<Border>::iterator find_entry(std::uint32_t other) {
    return std::lower_bound(list_.begin(), list_.end(), other, is_before);
  }

  std::vector<Border> list_;
};

}  // namespace relief
