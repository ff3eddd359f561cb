#include "renderer/clip/lines/plane_line.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace relief {

SplatFrame frame_of(const SplatDiscs& discs, const Disc& disc) {
  const glm::dvec3 normal = glm::normalize(discs.normals[disc.splat]);
  if (!discs.major_axes.empty()) {
    const glm::dvec3 major = discs.major_axes[disc.splat];
    return {normal, major, glm::cross(normal, major), disc.radius, discs.minor_radii[disc.splat]};
  }
  const glm::dvec3 other = std::abs(normal.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 x = glm::normalize(glm::cross(other, normal));
  return {normal, x, glm::cross(normal, x), disc.radius, disc.radius};
}

std::optional<PlaneLine> line_of(const SplatFrame& frame, const Disc& other, const Partner& partner,
                                 bool is_concave, std::uint32_t number) {
  // On a smaller sine the line is far off for a slight error of the normals.
  constexpr double kMinSine = 0.1;
  const glm::dvec2 towards(glm::dot(other.normal, frame.x), glm::dot(other.normal, frame.y));
  const double sine = glm::length(towards);
  if (!(sine > kMinSine)) return std::nullopt;
  const glm::dvec2 seen = towards / sine;
  const double distance = -partner.splat_above / sine;
  const glm::dvec2 along(-seen.y, seen.x);
  const glm::dvec2 centre(glm::dot(partner.centre, frame.x), glm::dot(partner.centre, frame.y));
  // The edge is where both discs are, so within their common span.
  const auto on_line = [&](double t) {
    const glm::dvec3 p = partner.line.origin + t * partner.line.direction;
    return glm::dot(glm::dvec2(glm::dot(p, frame.x), glm::dot(p, frame.y)), along);
  };
  const double from = on_line(partner.span.from);
  const double to = on_line(partner.span.to);
  const double place = std::clamp(glm::dot(centre, along), std::min(from, to), std::max(from, to));
  return PlaneLine{is_concave ? -seen : seen, is_concave ? -distance : distance,
                   distance * seen + place * along, number};
}

}  // namespace relief
