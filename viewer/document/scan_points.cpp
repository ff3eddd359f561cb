#include "viewer/document/scan_points.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>

namespace relief {
namespace {

/// sRGB of a point without a colour that faces down, and what it has more if it faces up.
constexpr float kDarkest = 70.0F;
constexpr float kRange = 150.0F;

bool is_finite(const glm::dvec3& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

/// A step that visits all of `count` places in an order that looks random: near the golden ratio of
/// them, and without a common factor.
std::size_t step_of(std::size_t count) {
  auto step = std::max<std::size_t>(1, static_cast<std::size_t>(0.618 * double(count)));
  while (std::gcd(step, count) != 1) ++step;
  return step;
}

glm::u8vec4 colour_of(const Points& points, std::size_t index, const glm::vec3& up) {
  if (!points.colours.empty()) return {points.colours[index], 255};
  float facing = 0.5F;
  if (!points.normals.empty()) {
    const glm::vec3 normal = points.normals[index];
    const float length = glm::length(normal);
    if (std::isfinite(length) && length > 0.0F) facing += 0.5F * glm::dot(normal, up) / length;
  }
  return {glm::u8vec3(static_cast<std::uint8_t>(kDarkest + kRange * facing)), 255};
}

/// As if the points were spread evenly over half the surface of their box.
double spacing_of(const Bounds& bounds, std::size_t count) {
  const glm::dvec3 s = bounds.max - bounds.min;
  return std::sqrt((s.x * s.y + s.y * s.z + s.z * s.x) / static_cast<double>(count));
}

}  // namespace

ScanPoints scan_points_of(const Points& points) {
  ScanPoints shown;
  const std::size_t count = points.size();
  shown.total = count;
  if (count == 0) return shown;
  set_extent(shown.extent, points.positions);
  shown.extent.stance = stance_of(points);
  const Bounds& bounds = shown.extent.bounds;
  shown.origin = 0.5 * (bounds.min + bounds.max);
  const std::size_t kept = std::min(count, kMostShownPoints);
  shown.points.reserve(kept);
  const std::size_t step = step_of(count);
  const glm::vec3 up(shown.extent.stance.up);
  for (std::size_t k = 0, index = 0; k < kept; ++k, index = (index + step) % count) {
    const glm::dvec3& position = points.positions[index];
    if (!is_finite(position)) continue;
    shown.points.push_back({glm::vec3(position - shown.origin), colour_of(points, index, up)});
  }
  shown.spacing = spacing_of(bounds, std::max<std::size_t>(shown.points.size(), 1));
  shown.extent.spacing = shown.spacing;
  return shown;
}

}  // namespace relief
