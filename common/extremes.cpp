#include "common/extremes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <limits>
#include <numeric>
#include <tuple>

namespace relief {
namespace {

/// Half of the directions; the others are opposite. Primitive vectors of whole numbers from -2 to
/// 2, the first that is not 0 above it.
constexpr int kReach = 2;
constexpr std::size_t kAxes = 49;
using Axis = std::array<std::int32_t, 3>;

constexpr std::array<Axis, kAxes> axes() {
  std::array<Axis, kAxes> list{};
  std::size_t count = 0;
  for (std::int32_t x = 0; x <= kReach; ++x) {
    for (std::int32_t y = x > 0 ? -kReach : 0; y <= kReach; ++y) {
      for (std::int32_t z = x > 0 || y > 0 ? -kReach : 1; z <= kReach; ++z) {
        if (std::gcd(x, std::gcd(y, z)) == 1) list.at(count++) = {x, y, z};
      }
    }
  }
  return list;
}

/// As many points as fit into the first-level cache with their coordinates.
constexpr std::size_t kBlock = 1024;

/// The points of a block, by coordinate, in steps of the bounds.
struct Block {
  std::array<std::int32_t, kBlock> x;
  std::array<std::int32_t, kBlock> y;
  std::array<std::int32_t, kBlock> z;
  std::size_t count = 0;

  void add(const glm::u16vec3& steps) {
    x[count] = steps.x;
    y[count] = steps.y;
    z[count] = steps.z;
    ++count;
  }
  [[nodiscard]] glm::u16vec3 at(std::size_t i) const { return {x[i], y[i], z[i]}; }
};

/// The farthest points so far along an axis, one way and the other.
struct Ends {
  std::int32_t lowest = std::numeric_limits<std::int32_t>::max();
  std::int32_t highest = std::numeric_limits<std::int32_t>::min();
  glm::u16vec3 low{0};
  glm::u16vec3 high{0};
};

void extend(const Block& block, const Axis& axis, Ends& ends) {
  std::array<std::int32_t, kBlock> along;
  std::int32_t lowest = ends.lowest;
  std::int32_t highest = ends.highest;
  for (std::size_t i = 0; i < block.count; ++i) {
    along[i] = axis[0] * block.x[i] + axis[1] * block.y[i] + axis[2] * block.z[i];
    lowest = std::min(lowest, along[i]);
    highest = std::max(highest, along[i]);
  }
  const auto point_at = [&](std::int32_t value) {
    const std::span filled = std::span(along).first(block.count);
    return block.at(static_cast<std::size_t>(std::ranges::find(filled, value) - filled.begin()));
  };
  if (lowest < ends.lowest) ends.low = point_at(lowest);
  if (highest > ends.highest) ends.high = point_at(highest);
  ends.lowest = lowest;
  ends.highest = highest;
}

}  // namespace

glm::dvec3 extreme_at(const glm::u16vec3& steps, const Bounds& bounds) {
  return bounds.min + glm::dvec3(steps) / kExtremeSteps * (bounds.max - bounds.min);
}

glm::u16vec3 extreme_steps(const glm::dvec3& position, const Bounds& bounds) {
  glm::u16vec3 steps(0);
  for (glm::length_t c = 0; c < 3; ++c) {
    const double size = bounds.max[c] - bounds.min[c];
    const double share = size > 0.0 ? (position[c] - bounds.min[c]) / size : 0.0;
    steps[c] = static_cast<std::uint16_t>(std::lround(std::clamp(share, 0.0, 1.0) * kExtremeSteps));
  }
  return steps;
}

std::vector<glm::dvec3> extreme_points(std::span<const glm::dvec3> positions,
                                       const Bounds& bounds) {
  if (positions.empty() || bounds.empty()) return {};
  static constexpr std::array<Axis, kAxes> kDirections = axes();
  std::array<Ends, kAxes> ends;
  Block block;
  for (std::size_t first = 0; first < positions.size(); first += kBlock) {
    block.count = 0;
    for (const glm::dvec3& p : positions.subspan(first, std::min(kBlock, positions.size() - first)))
      block.add(extreme_steps(p, bounds));
    for (std::size_t a = 0; a < kAxes; ++a) extend(block, kDirections[a], ends[a]);
  }
  std::vector<glm::u16vec3> found;
  for (const Ends& pair : ends) found.insert(found.end(), {pair.low, pair.high});
  const auto order = [](const glm::u16vec3& p) { return std::tuple(p.x, p.y, p.z); };
  std::ranges::sort(found, {}, order);
  found.erase(std::unique(found.begin(), found.end()), found.end());
  std::vector<glm::dvec3> points;
  points.reserve(found.size());
  for (const glm::u16vec3& steps : found) points.push_back(extreme_at(steps, bounds));
  return points;
}

std::vector<glm::dvec3> corners_of(const Bounds& bounds) {
  std::vector<glm::dvec3> corners;
  if (bounds.empty()) return corners;
  for (const double x : {bounds.min.x, bounds.max.x}) {
    for (const double y : {bounds.min.y, bounds.max.y}) {
      for (const double z : {bounds.min.z, bounds.max.z}) corners.emplace_back(x, y, z);
    }
  }
  return corners;
}

}  // namespace relief
