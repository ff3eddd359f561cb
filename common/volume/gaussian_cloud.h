// A scene of 3D Gaussians [Kerbl 2023].
#pragma once

#include <cstddef>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "common/stance.h"

namespace relief {

/// Largest degree of spherical harmonics that a file can have.
inline constexpr int kMaxHarmonicsDegree = 4;

/// Coefficients of spherical harmonics up to a degree, for each of R, G and B.
[[nodiscard]] constexpr std::size_t harmonics_of(int degree) {
  return static_cast<std::size_t>(degree + 1) * static_cast<std::size_t>(degree + 1);
}

/// Gaussians in a right-handed world frame with Y up and Z toward the viewer. All arrays but
/// `harmonics` have one element for each Gaussian.
struct GaussianCloud {
  std::vector<glm::vec3> centres;
  std::vector<glm::vec3> scales;     ///< standard deviations along the own axes, above 0
  std::vector<glm::quat> rotations;  ///< from the own axes to the world, of length 1
  std::vector<float> opacities;      ///< at the centre, 0 to 1
  int degree = 0;                    ///< 0 to kMaxHarmonicsDegree
  /// harmonics_of(degree) for each Gaussian, by degree and order: a colour (encoded sRGB) seen
  /// along a direction d is 0.5 + the sum of each times its basis function of d.
  std::vector<glm::vec3> harmonics;
  /// Trained with the anti-aliasing filter that keeps a Gaussian's integral.
  bool is_antialiased = false;
  Stance stance;

  [[nodiscard]] std::size_t size() const { return centres.size(); }
};

}  // namespace relief
