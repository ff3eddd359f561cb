// The basis functions of splats.
#pragma once

#include <Eigen/SparseCore>

#include "preprocess/texture/acquisition/acquisition.h"
#include "preprocess/texture/acquisition/surface_points.h"

namespace relief {

struct SplatBasis {
  double deviation = 0.0;  ///< h of section 5, world units: variance h^2 I in the tangent plane
  double cutoff = 1.0;     ///< c of section 4: r_k ends where its exponent reaches it
  BasisKind kind = BasisKind::Normalised;
};

/// Returns the matrix whose row q, column k is basis function k at `positions[q]`, in the tangent
/// plane of splat k (section 4). A splat reaches only positions whose normals face its side. The
/// result does not depend on the number of threads.
[[nodiscard]] Eigen::SparseMatrix<double, Eigen::RowMajor> evaluate_basis(
    const SurfacePoints& splats, const SplatBasis& basis, const SurfacePoints& positions);

}  // namespace relief
