// Sectors of the plane about a position in which there is no point.
#pragma once

#include <algorithm>
#include <cstddef>
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

}  // namespace relief
