#include "renderer/clip/pairs/disc_overlap.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace relief {
namespace {

/// The roots of A t^2 + 2 B t + C = 0 if there are two.
std::optional<Span> between_roots(double a, double b, double c) {
  const double discriminant = b * b - a * c;
  if (!(discriminant > 0.0)) return std::nullopt;
  const double root = std::sqrt(discriminant);
  return Span{(-b - root) / a, (-b + root) / a};
}

std::optional<Span> span_in_disc(const SplatDiscs& discs, const CrossingLine& line,
                                 const Disc& disc) {
  if (discs.major_axes.empty()) return span_in_circle(line, disc.radius);
  const glm::dvec3 major = discs.major_axes[disc.splat];
  return span_in_ellipse(
      line, {major, glm::cross(disc.normal, major), disc.radius, discs.minor_radii[disc.splat]});
}

}  // namespace

CrossingLine crossing_line(const Disc& first, const Disc& second) {
  // Eq. (7) with the first centre as the origin: P n_i = 0, P n_j = h.
  const double h = glm::dot(second.normal, second.centre - first.centre);
  const double cosine = glm::dot(first.normal, second.normal);
  const glm::dvec3 direction = glm::cross(first.normal, second.normal);
  const double squared_sine = glm::dot(direction, direction);
  return {(h / squared_sine) * (second.normal - cosine * first.normal),
          direction / std::sqrt(squared_sine)};
}

std::optional<Span> span_in_circle(const CrossingLine& line, double radius) {
  return between_roots(1.0, glm::dot(line.origin, line.direction),
                       glm::dot(line.origin, line.origin) - radius * radius);
}

std::optional<Span> span_in_ellipse(const CrossingLine& line, const Ellipse& ellipse) {
  // In units of the semi-axes the ellipse is the unit circle.
  const double du = glm::dot(line.direction, ellipse.major_axis) / ellipse.major_radius;
  const double dv = glm::dot(line.direction, ellipse.minor_axis) / ellipse.minor_radius;
  const double ou = glm::dot(line.origin, ellipse.major_axis) / ellipse.major_radius;
  const double ov = glm::dot(line.origin, ellipse.minor_axis) / ellipse.minor_radius;
  return between_roots(du * du + dv * dv, ou * du + ov * dv, ou * ou + ov * ov - 1.0);
}

std::optional<Span> common_span(const SplatDiscs& discs, const CrossingLine& line,
                                const Disc& first, const Disc& second) {
  const auto in_first = span_in_disc(discs, line, first);
  if (!in_first) return std::nullopt;
  const glm::dvec3 origin = line.origin - (second.centre - first.centre);
  const auto in_second = span_in_disc(discs, {origin, line.direction}, second);
  if (!in_second) return std::nullopt;
  const Span both{std::max(in_first->from, in_second->from), std::min(in_first->to, in_second->to)};
  return both.from < both.to ? std::optional(both) : std::nullopt;
}

}  // namespace relief
