// The colour spaces of FLIP (2020, section 4.1). XYZ values are divided by those of white (D65), so
// that white is (1, 1, 1).
#pragma once

#include <cmath>
#include <glm/vec3.hpp>

namespace relief {

/// Returns XYZ of linear RGB (Rec. 709).
[[nodiscard]] inline glm::vec3 xyz_from_rgb(const glm::vec3& c) {
  // The matrix of sRGB in exact fractions, rows divided by their sums, which are white.
  constexpr float kX = 10135552.0F + 8788810.0F + 4435075.0F;
  constexpr float kY = 2613072.0F + 8788810.0F + 887015.0F;
  constexpr float kZ = 1425312.0F + 8788810.0F + 70074185.0F;
  return {(10135552.0F * c.x + 8788810.0F * c.y + 4435075.0F * c.z) / kX,
          (2613072.0F * c.x + 8788810.0F * c.y + 887015.0F * c.z) / kY,
          (1425312.0F * c.x + 8788810.0F * c.y + 70074185.0F * c.z) / kZ};
}

/// Returns linear RGB of XYZ.
[[nodiscard]] inline glm::vec3 rgb_from_xyz(const glm::vec3& c) {
  return {3.080341988F * c.x - 1.537398969F * c.y - 0.542943019F * c.z,
          -0.921178396F * c.x + 1.875929984F * c.y + 0.045248412F * c.z,
          0.052881293F * c.x - 0.204011206F * c.y + 1.151129913F * c.z};
}

/// Returns L*a*b* with the Hunt adjustment: colours fade as they get darker.
[[nodiscard]] inline glm::vec3 hunt_lab_from_xyz(const glm::vec3& c) {
  const auto bend = [](float t) {
    constexpr float kKnee = 6.0F / 29.0F;
    return t > kKnee * kKnee * kKnee ? std::cbrt(t) : t / (3.0F * kKnee * kKnee) + 4.0F / 29.0F;
  };
  const float x = bend(c.x);
  const float y = bend(c.y);
  const float z = bend(c.z);
  const float lightness = 116.0F * y - 16.0F;
  const float fade = 0.01F * lightness;
  return {lightness, fade * 500.0F * (x - y), fade * 200.0F * (y - z)};
}

/// Returns the HyAB distance, for large differences, city-block in lightness, Euclidean in the
/// rest.
[[nodiscard]] inline float hyab_distance(const glm::vec3& a, const glm::vec3& b) {
  const float da = a.y - b.y;
  const float db = a.z - b.z;
  return std::abs(a.x - b.x) + std::sqrt(da * da + db * db);
}

/// Returns the difference, in [0, 1], of two colours from hunt_lab_from_xyz. Large distances are
/// compressed: those above 0.4 of the largest (green against blue) share the last 0.05.
[[nodiscard]] inline float colour_difference(const glm::vec3& a, const glm::vec3& b) {
  constexpr float kExponent = 0.7F;
  constexpr float kBendAt = 0.4F;
  constexpr float kBendTo = 0.95F;
  static const float largest =
      std::pow(hyab_distance(hunt_lab_from_xyz(xyz_from_rgb({0.0F, 1.0F, 0.0F})),
                             hunt_lab_from_xyz(xyz_from_rgb({0.0F, 0.0F, 1.0F}))),
               kExponent);
  const float share = std::pow(hyab_distance(a, b), kExponent) / largest;
  if (share < kBendAt) return share * (kBendTo / kBendAt);
  return kBendTo + (share - kBendAt) / (1.0F - kBendAt) * (1.0F - kBendTo);
}

}  // namespace relief
