// Turns colours that depend on the direction.
#pragma once

#include <array>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "common/volume/spherical_harmonics.h"

namespace relief {

/// What an orthogonal matrix Q (a rotation or a mirror) does to spherical harmonics: a colour along
/// Q d becomes what it was along d. Exact but for rounding, since Q maps the functions of one
/// degree to one another.
class HarmonicsTurn {
 public:
  /// Of coefficients up to a degree (0 to 4).
  HarmonicsTurn(const glm::dmat3& q, int degree);

  /// Turns the coefficients of one Gaussian: harmonics_of(degree) of them.
  void apply(std::span<glm::vec3> coefficients) const;

 private:
  static constexpr std::size_t kCount = harmonics_of(kMaxHarmonicsDegree);

  int degree_;
  /// Row and column: the coefficient after and before. Only blocks of one degree are not zero.
  std::array<std::array<double, kCount>, kCount> matrix_{};
};

}  // namespace relief
