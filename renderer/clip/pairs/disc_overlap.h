// Where two discs cross.
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "renderer/clip/pairs/disc_tree.h"

namespace relief {

/// The line P(t) = origin + t * direction in which the planes of two discs cross.
struct CrossingLine {
  glm::dvec3 origin;     ///< the line's nearest point to the first centre, relative to it
  glm::dvec3 direction;  ///< unit
};

/// A part of such a line.
struct Span {
  double from;
  double to;
};

/// Returns the line in which the planes of two discs cross, relative to the first one's centre
/// ([Ivo 2011], Eq. (5) to (8)). The planes must not be parallel.
[[nodiscard]] CrossingLine crossing_line(const Disc& first, const Disc& second);

/// Returns the part of a line in a circle about the origin; none if it misses or only touches it
/// (Eq. (13)).
[[nodiscard]] std::optional<Span> span_in_circle(const CrossingLine& line, double radius);

/// An ellipse about the origin.
struct Ellipse {
  glm::dvec3 major_axis;  ///< unit
  glm::dvec3 minor_axis;  ///< unit
  double major_radius;
  double minor_radius;
};

/// Returns the part of a line that lies in an ellipse, by Eq. (12) with P_o relative to the centre.
/// The line lies in the ellipse's plane.
[[nodiscard]] std::optional<Span> span_in_ellipse(const CrossingLine& line, const Ellipse& ellipse);

/// Returns the part of the crossing line that lies in both discs; none if the discs do not cross
/// (section III.C). `line` is relative to the first one's centre.
[[nodiscard]] std::optional<Span> common_span(const SplatDiscs& discs, const CrossingLine& line,
                                              const Disc& first, const Disc& second);

}  // namespace relief
