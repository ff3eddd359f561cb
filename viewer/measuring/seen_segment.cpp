#include "viewer/measuring/seen_segment.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "viewer/navigation/projection.h"

namespace relief {
namespace {

/// Of the nearer end of a line that goes behind the eye, in parts of the farther end's depth.
constexpr double kNearest = 1e-6;
constexpr int kArcSteps = 24;

/// Cuts a line to a box (Liang and Barsky 1984).
std::optional<SeenSegment> clip(const SeenSegment& line, glm::dvec2 low, glm::dvec2 high) {
  double first = 0.0;
  double last = 1.0;
  const glm::dvec2 along = line.to - line.from;
  for (const glm::length_t c : {0, 1}) {
    if (along[c] == 0.0) {
      if (line.from[c] < low[c] || line.from[c] > high[c]) return std::nullopt;
      continue;
    }
    double enters = (low[c] - line.from[c]) / along[c];
    double leaves = (high[c] - line.from[c]) / along[c];
    if (enters > leaves) std::swap(enters, leaves);
    first = std::max(first, enters);
    last = std::min(last, leaves);
  }
  if (!(first <= last)) return std::nullopt;
  return SeenSegment{line.from + first * along, line.from + last * along};
}

}  // namespace

std::optional<SeenSegment> seen_segment(const Camera& camera, glm::dvec3 from, glm::dvec3 to,
                                        glm::dvec2 size, double margin) {
  const double from_depth = depth_of(camera, from);
  const double to_depth = depth_of(camera, to);
  const double near = kNearest * std::max(from_depth, to_depth);
  if (!(near > 0.0)) return std::nullopt;
  const auto at_near = [&] {
    return glm::mix(from, to, (near - from_depth) / (to_depth - from_depth));
  };
  const auto a = project(camera, from_depth < near ? at_near() : from, size);
  const auto b = project(camera, to_depth < near ? at_near() : to, size);
  if (!a || !b) return std::nullopt;
  return clip({*a, *b}, glm::dvec2(-margin), size + margin);
}

std::vector<glm::dvec3> angle_arc(glm::dvec3 first, glm::dvec3 corner, glm::dvec3 last) {
  const double near = glm::distance(first, corner);
  const double far = glm::distance(last, corner);
  if (near == 0.0 || far == 0.0) return {};
  const glm::dvec3 start = (first - corner) / near;
  const glm::dvec3 end = (last - corner) / far;
  const glm::dvec3 across = end - glm::dot(start, end) * start;
  const double sine = glm::length(across);
  if (sine == 0.0) return {};
  const double angle = std::atan2(sine, glm::dot(start, end));
  std::vector<glm::dvec3> arc;
  for (int k = 0; k <= kArcSteps; ++k) {
    const double turned = angle * k / kArcSteps;
    arc.push_back(corner + std::min(near, far) / 3.0 *
                               (std::cos(turned) * start + std::sin(turned) / sine * across));
  }
  return arc;
}

glm::dvec3 height_corner(glm::dvec3 from, glm::dvec3 to, glm::dvec3 up) {
  const glm::dvec3 unit = glm::normalize(up);
  return from + glm::dot(to - from, unit) * unit;
}

}  // namespace relief
