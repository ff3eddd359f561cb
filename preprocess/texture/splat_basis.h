// The basis functions of splats, and what they make of coefficients.
#pragma once

#include <Eigen/SparseCore>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "preprocess/texture/surface_points.h"

namespace relief {

/// How the Gaussians r_k of paper 000, section 3.1, become a function on the surface. Both kinds
/// are scaled to sum to 1, so that a constant texture has that constant as its coefficients.
enum class BasisKind : std::uint8_t {
  /// r_k / sum_j r_j: what an engine shows that divides by the sum of the contributions, Eq. (9).
  /// The sum is exactly 1.
  Normalised,
  /// h^2 r_k / (1 - exp(-cutoff)): r_k itself up to a factor, as in Eq. (1), (7) and (11). With one
  /// point for each h^2 of the surface the sum is 1 on average only.
  Plain,
};

struct SplatBasis {
  double deviation = 0.0;  ///< h of section 5, world units: variance h^2 I in the tangent plane
  double cutoff = 1.0;     ///< c of section 4: r_k ends where its exponent reaches it
  BasisKind kind = BasisKind::Normalised;
};

/// Row q, column k: basis function k at `places[q]`, in the tangent plane of splat k (section 4).
/// A splat reaches only places that face the same way. Does not depend on the number of threads.
[[nodiscard]] Eigen::SparseMatrix<double, Eigen::RowMajor> evaluate_basis(
    const SurfacePoints& splats, const SplatBasis& basis, const SurfacePoints& places);

}  // namespace relief
