#include "renderer/engines/ewa/clip_lines.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace relief::ewa {
namespace {

/// Deviations a pixel where there is no filter.
constexpr double kSharp = 1e6;
/// Of a line at infinity, whose function is constant.
constexpr double kLeast = 1e-300;

}  // namespace

glm::dvec3 beyond_line(const PixelMapping& mapping, glm::dvec3 point, glm::dvec3 normal,
                       glm::dvec3 direction, double offset) {
  if (mapping.orthographic) {
    const glm::dvec2 change =
        (glm::dvec2(direction) - direction.z / normal.z * glm::dvec2(normal)) / mapping.scale;
    return {change, -offset};
  }
  // A ray d meets the plane at d (n.p / n.d). There the offset from p is beyond the line by
  // (d.D) (n.p / n.d) - p.D - offset; before the eye n.p / n.d is above 0, and |n.d| times that is
  // linear in d.
  const double facing = glm::dot(normal, point);
  const double side = facing < 0.0 ? -1.0 : 1.0;
  const glm::dvec2 change = (facing * glm::dvec2(direction) -
                             (glm::dot(point, direction) + offset) * glm::dvec2(normal)) /
                            mapping.scale;
  return side * glm::dvec3(change, -offset * facing / point.z);
}

SeenSplat seen_splat(const TangentMapping& plane, double radius, EwaFilter filter) {
  if (filter == EwaFilter::Unfiltered) return {};
  const glm::dmat2 variance = radius * radius * plane.to_pixels * glm::transpose(plane.to_pixels);
  return {variance * glm::inverse(variance + glm::dmat2(kPixelVariance)), kPixelVariance};
}

ImageLine image_line(glm::dvec3 beyond, const SeenSplat& seen, bool ends_group) {
  const glm::dvec2 across(beyond);
  const glm::dvec2 mean = seen.mean * across;
  const double deviation = std::sqrt(std::max(seen.filter * glm::dot(across, mean), 0.0));
  if (deviation > 0.0) return {glm::dvec3(mean, beyond.z) / deviation, ends_group};
  return {beyond * (kSharp / std::max(glm::length(across), kLeast)), ends_group};
}

double kept_mass(std::span<const ClipLine> lines, double radius) {
  double kept = 1.0;
  double of_group = 0.0;
  for (const ClipLine& line : lines) {
    const double distance = double{line.offset} / radius;
    of_group = std::max(of_group, 0.5 * std::erfc(-distance / std::numbers::sqrt2));
    if (!line.ends_group) continue;
    kept *= of_group;
    of_group = 0.0;
  }
  return std::max(kept, kLeastKept);
}

}  // namespace relief::ewa
