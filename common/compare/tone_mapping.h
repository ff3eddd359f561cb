// Tone mapping as in HDR-FLIP.
#pragma once

#include <algorithm>
#include <cmath>

namespace relief {

/// Narkowicz's fit to the ACES curve with its exposure of 0.6, numerator and denominator as
/// polynomials of light: (a x^2 + b x) / (c x^2 + d x + e).
struct AcesCurve {
  static constexpr float kA = 0.6F * 0.6F * 2.51F;
  static constexpr float kB = 0.6F * 0.03F;
  static constexpr float kC = 0.6F * 0.6F * 2.43F;
  static constexpr float kD = 0.6F * 0.59F;
  static constexpr float kE = 0.14F;
};

/// Returns the display's light, in [0, 1], for `light` (0 or more, finite) multiplied by `gain`
/// (above 0).
[[nodiscard]] inline float tone_map(float light, double gain) {
  // The curve is above 1 from 8 on; bounded, its squares stay finite at any exposure.
  constexpr double kBright = 1e4;
  const auto x = static_cast<float>(std::min(light * gain, kBright));
  const float shown = (x * (AcesCurve::kA * x + AcesCurve::kB)) /
                      (x * (AcesCurve::kC * x + AcesCurve::kD) + AcesCurve::kE);
  return std::min(shown, 1.0F);
}

/// Returns the light that is tone-mapped to `shown`, in [0, 1).
[[nodiscard]] inline double light_shown_as(double shown) {
  // (a - shown c) x^2 + (b - shown d) x - shown e = 0, the root above 0.
  const double a = double{AcesCurve::kA} - shown * double{AcesCurve::kC};
  const double b = double{AcesCurve::kB} - shown * double{AcesCurve::kD};
  const double c = -shown * double{AcesCurve::kE};
  return (-b + std::sqrt(b * b - 4.0 * a * c)) / (2.0 * a);
}

}  // namespace relief
