// What a ray gathers, front to back.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/vec3.hpp>
#include <limits>

namespace relief::volume_truth {

/// What is behind this no longer counts.
inline constexpr double kMinTransmittance = 1e-6;

struct RaySum {
  glm::dvec3 colour{0.0};  ///< times its opacity
  double transmittance = 1.0;
  /// Along the view axis: where half of what is behind is covered; infinite if nothing is.
  double depth = std::numeric_limits<double>::infinity();

  [[nodiscard]] bool is_done() const { return transmittance < kMinTransmittance; }
};

/// Part of a ray, from one depth to another.
struct Segment {
  double from = 0.0;
  double to = 0.0;
  double optical_depth = 0.0;
  glm::dvec3 first{0.0};  ///< the colours at its ends: emission divided by extinction
  glm::dvec3 last{0.0};
};

/// The light of a segment and its opacity; exact where the colour is linear in the optical depth.
[[nodiscard]] inline glm::dvec3 light_of(const Segment& segment) {
  const double d = segment.optical_depth;
  const double opacity = -std::expm1(-d);
  // (1 - (1 + d) exp(-d)) / d, without cancellation.
  const double of_change =
      d < 1e-3 ? d * (0.5 - d * (1.0 / 3.0 - 0.125 * d)) : (opacity - d * std::exp(-d)) / d;
  return opacity * segment.first + of_change * (segment.last - segment.first);
}

/// Puts a segment behind what the ray has gathered. An optical depth slightly below 0 is one.
inline void add(RaySum& sum, const Segment& segment) {
  if (segment.optical_depth == 0.0) return;
  sum.colour += sum.transmittance * light_of(segment);
  const double after = sum.transmittance * std::exp(-segment.optical_depth);
  if (sum.transmittance > 0.5 && after <= 0.5) {
    const double share = std::log(2.0 * sum.transmittance) / segment.optical_depth;
    sum.depth = segment.from + std::clamp(share, 0.0, 1.0) * (segment.to - segment.from);
  }
  sum.transmittance = after;
}

/// Likewise something thin of that opacity and colour.
inline void add_surface(RaySum& sum, double opacity, glm::dvec3 colour, double depth) {
  sum.colour += sum.transmittance * opacity * colour;
  const double after = sum.transmittance * (1.0 - opacity);
  if (sum.transmittance > 0.5 && after <= 0.5) sum.depth = depth;
  sum.transmittance = after;
}

}  // namespace relief::volume_truth
