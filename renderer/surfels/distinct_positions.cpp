#include "renderer/surfels/distinct_positions.h"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <tuple>

#include "common/is_finite.h"

namespace relief {
namespace {

/// A frame that holds all finite positions. Halves are added, since a sum might overflow.
struct CommonFrame {
  glm::dvec3 middle{0.0};
  double unit = 1.0;
};

CommonFrame frame_of(std::span<const glm::dvec3> positions) {
  glm::dvec3 low(std::numeric_limits<double>::infinity());
  glm::dvec3 high = -low;
  for (const glm::dvec3 p : positions) {
    if (!is_finite(p)) continue;
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  if (!(low.x <= high.x)) return {};
  const glm::dvec3 half = high / 2.0 - low / 2.0;
  const double unit = std::max({half.x, half.y, half.z});
  // Below that 1 / unit overflows.
  return {high / 2.0 + low / 2.0, unit > std::numeric_limits<double>::min() ? unit : 1.0};
}

}  // namespace

DistinctPositions find_distinct_positions(std::span<const glm::dvec3> positions) {
  DistinctPositions distinct;
  const CommonFrame frame = frame_of(positions);
  distinct.unit = frame.unit;
  distinct.of.assign(positions.size(), DistinctPositions::kNone);
  struct Placed {
    glm::dvec3 at;
    std::uint32_t point;
  };
  std::vector<Placed> placed;
  placed.reserve(positions.size());
  for (std::uint32_t k = 0; k < positions.size(); ++k) {
    if (is_finite(positions[k])) placed.push_back({(positions[k] - frame.middle) / frame.unit, k});
  }
  tbb::parallel_sort(placed.begin(), placed.end(), [](const Placed& a, const Placed& b) {
    return std::tie(a.at.x, a.at.y, a.at.z, a.point) < std::tie(b.at.x, b.at.y, b.at.z, b.point);
  });
  // Each point's first twin, whose index is then replaced by its place among the distinct.
  for (std::size_t s = 0; s < placed.size(); ++s) {
    const bool is_twin = s > 0 && placed[s].at == placed[s - 1].at;
    distinct.of[placed[s].point] = is_twin ? distinct.of[placed[s - 1].point] : placed[s].point;
  }
  for (std::uint32_t k = 0; k < positions.size(); ++k) {
    std::uint32_t& of = distinct.of[k];
    if (of == DistinctPositions::kNone) continue;
    if (of != k) {
      of = distinct.of[of];
      continue;
    }
    of = static_cast<std::uint32_t>(distinct.positions.size());
    distinct.positions.push_back((positions[k] - frame.middle) / frame.unit);
  }
  return distinct;
}

}  // namespace relief
