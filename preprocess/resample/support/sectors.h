// Sectors of the plane about a position in which there is no point.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

namespace relief {

/// The widest sectors without a direction.
struct WidestSectors {
  double begin = 0.0;   ///< of the widest one, radians
  double width = 0.0;   ///< of that one
  double second = 0.0;  ///< width of the next
};

/// Finds them among the angles of directions (radians), which it sorts. Without any direction the
/// widest is the whole circle.
inline WidestSectors widest_sectors(std::vector<double>& angles) {
  constexpr double kCircle = 2.0 * std::numbers::pi;
  if (angles.empty()) return {0.0, kCircle, 0.0};
  std::sort(angles.begin(), angles.end());
  WidestSectors widest;
  for (std::size_t k = 0; k < angles.size(); ++k) {
    const double next = k + 1 < angles.size() ? angles[k + 1] : angles.front() + kCircle;
    const double width = next - angles[k];
    if (width > widest.width) {
      widest = {angles[k], width, widest.width};
    } else {
      widest.second = std::max(widest.second, width);
    }
  }
  return widest;
}

/// Twelve sectors of 30 degrees, and which of them hold a direction: a cheap first look, without
/// angles.
class TwelveSectors {
 public:
  /// (0, 0) is no direction.
  void add(double x, double y) {
    if (x == 0.0 && y == 0.0) return;
    constexpr double kTan30 = 0.57735026918962576;
    const double across = std::abs(x);
    const double up = std::abs(y);
    const unsigned from_axis = (up > kTan30 * across ? 1U : 0U) + (kTan30 * up > across ? 1U : 0U);
    const unsigned half = x >= 0.0 ? from_axis : 5U - from_axis;
    taken_ |= 1U << (y >= 0.0 ? half : 11U - half);
  }

  /// Whether a sector of 120 degrees or more may be empty: it has three of the twelve in it.
  [[nodiscard]] bool may_leave_120_degrees() const {
    const std::uint32_t free = ~taken_ & 0xFFFU;
    const std::uint32_t twice = free | free << 12U;
    return (twice & twice >> 1U & twice >> 2U) != 0;
  }

 private:
  std::uint32_t taken_ = 0;
};

}  // namespace relief
