#include "preprocess/readers/las/airborne.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>

namespace relief {
namespace {

// Figures of vol_total, autzen_trim (both airborne) and lone-star (terrestrial): width over height
// 4.3, 5.5, 1.7; points of a crowded cell over the median 2.3, 2.9, 21; share of points in tall
// cells 0.05, 0.27, 0.74. docs/decisions/0105 has more.
constexpr double kLeastWidth = 3.0;    // heights
constexpr double kMostCrowded = 8.0;   // medians
constexpr double kMostTall = 0.4;      // of the points
constexpr double kCellSide = 4.0;      // mean distances of points on the map
constexpr double kTallCell = 2.0;      // sides
constexpr std::size_t kFewest = 1000;  // points, for the figures to mean something

/// The middle 98 % of the values along an axis.
struct Range {
  double low;
  double high;
  [[nodiscard]] double length() const { return high - low; }
};

Range middle(const std::vector<glm::dvec3>& sample, int axis) {
  std::vector<double> values;
  values.reserve(sample.size());
  for (const glm::dvec3& p : sample) values.push_back(p[axis]);
  const auto at = [&values](std::size_t rank) {
    const auto place = values.begin() + static_cast<std::ptrdiff_t>(rank);
    std::ranges::nth_element(values, place);
    return *place;
  };
  const std::size_t outer = values.size() / 100;
  const double low = at(outer);
  return {low, at(values.size() - 1 - outer)};
}

struct MapPoint {
  std::uint64_t cell;
  double height;
};

std::vector<MapPoint> map_of(const std::vector<glm::dvec3>& sample, Range x, Range y, double side) {
  std::vector<MapPoint> map;
  map.reserve(sample.size());
  for (const glm::dvec3& p : sample) {
    if (p.x < x.low || p.x > x.high || p.y < y.low || p.y > y.high) continue;
    const auto column = static_cast<std::uint64_t>((p.x - x.low) / side);
    const auto row = static_cast<std::uint64_t>((p.y - y.low) / side);
    map.push_back({row << 32U | column, p.z});
  }
  std::ranges::sort(map, {}, &MapPoint::cell);
  return map;
}

}  // namespace

bool looks_airborne(const std::vector<glm::dvec3>& sample, bool several_returns) {
  if (sample.size() < kFewest) return false;
  const Range x = middle(sample, 0);
  const Range y = middle(sample, 1);
  const Range z = middle(sample, 2);
  const double width = std::min(x.length(), y.length());
  if (!(width > 0.0) || width < kLeastWidth * z.length()) return false;

  const double side =
      kCellSide * std::sqrt(x.length() * y.length() / static_cast<double>(sample.size()));
  const std::vector<MapPoint> map = map_of(sample, x, y, side);
  std::vector<std::size_t> counts;
  std::size_t tall = 0;
  for (auto begin = map.begin(); begin != map.end();) {
    const auto end =
        std::find_if(begin, map.end(), [&](const MapPoint& p) { return p.cell != begin->cell; });
    const auto [low, high] = std::ranges::minmax_element(begin, end, {}, &MapPoint::height);
    counts.push_back(static_cast<std::size_t>(end - begin));
    if (high->height - low->height > kTallCell * side) tall += counts.back();
    begin = end;
  }
  std::ranges::sort(counts);
  const auto median = static_cast<double>(counts[counts.size() / 2]);
  const auto crowded = static_cast<double>(counts[counts.size() - 1 - counts.size() / 100]);
  const double tall_share = static_cast<double>(tall) / static_cast<double>(map.size());
  return crowded <= kMostCrowded * median && (several_returns || tall_share <= kMostTall);
}

}  // namespace relief
