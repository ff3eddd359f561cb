// Scenes whose axes point the other way.
#pragma once

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include "common/volume/spherical_harmonics.h"

namespace relief {

/// The axes of a file along those of GaussianCloud: 1, or -1 where a positive coordinate of the
/// file is a negative one of ours. Two of -1 are a half turn.
using AxisSigns = glm::vec3;

/// Right, down, front: PLY files, as cameras of COLMAP see.
inline constexpr AxisSigns kRightDownFront{1.0F, -1.0F, -1.0F};

/// The rotation F R F of a rotation R, where F is the diagonal matrix of the signs. With the own
/// axes turned, too, F R and F R F place the same Gaussian, and the latter is a rotation even if F
/// is a mirror.
[[nodiscard]] inline glm::dquat turned(const glm::dquat& rotation, AxisSigns signs) {
  const glm::dvec3 s(signs);
  return {rotation.w, s.y * s.z * rotation.x, s.x * s.z * rotation.y, s.x * s.y * rotation.z};
}

using HarmonicsSigns = std::array<float, harmonics_of(kMaxHarmonicsDegree)>;

/// What coefficients are multiplied by, so that a colour along F d is what it was along d. Each
/// basis function is even or odd along each axis, so that its sign at one direction holds for all.
[[nodiscard]] inline HarmonicsSigns harmonics_signs(AxisSigns signs) {
  constexpr std::size_t count = harmonics_of(kMaxHarmonicsDegree);
  // No function is near 0 there: the least is 0.05.
  const glm::dvec3 direction = glm::normalize(glm::dvec3(0.3, 0.5, 0.75));
  std::array<double, count> plain{};
  std::array<double, count> flipped{};
  harmonics_basis(direction, kMaxHarmonicsDegree, plain);
  harmonics_basis(glm::dvec3(signs) * direction, kMaxHarmonicsDegree, flipped);
  HarmonicsSigns out{};
  for (std::size_t c = 0; c < count; ++c)
    out[c] = std::signbit(plain[c]) == std::signbit(flipped[c]) ? 1.0F : -1.0F;
  return out;
}

}  // namespace relief
