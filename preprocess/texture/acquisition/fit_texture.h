// Computes the coefficients of a texture on splats.
#pragma once

#include <Eigen/SparseCore>
#include <glm/vec3.hpp>
#include <vector>

#include "common/progress.h"
#include "preprocess/texture/acquisition/acquisition.h"

namespace relief {

/// A basis at positions that represent equal shares of the surface, so that inner products over the
/// surface are means over the positions.
using BasisAtPositions = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// Returns the coefficients of view-independent EWA ([Zwicker 2001], section 5): w_k = <r_k,
/// texture> / <r_k, 1>, as if the basis were orthogonal. `texture`: values at the positions. A
/// splat that reaches no position gets its value of `fallback`.
[[nodiscard]] std::vector<glm::vec3> project_texture(const BasisAtPositions& basis,
                                                     const std::vector<glm::vec3>& texture,
                                                     const std::vector<glm::vec3>& fallback);

/// Returns the matrix R of Eq. (11): inner products of the basis functions, as means over the
/// positions.
[[nodiscard]] Eigen::SparseMatrix<double, Eigen::RowMajor> inner_products(
    const BasisAtPositions& basis);

/// Returns the optimised coefficients ([Zwicker 2001], section 5 and appendix A): the solution of R
/// w = c, which has the smallest L2 error against the texture. Starts from `start`, which remains
/// for splats that reach no position. Returns an intermediate result if `progress` is cancelled.
[[nodiscard]] std::vector<glm::vec3> fit_texture(const BasisAtPositions& basis,
                                                 const std::vector<glm::vec3>& texture,
                                                 const std::vector<glm::vec3>& start,
                                                 const Progress& progress, FitReport& report);

/// Returns the L2 error of Eq. (10) as an rms over the surface and the three channels, in texture
/// units.
[[nodiscard]] double rms_error(const BasisAtPositions& basis,
                               const std::vector<glm::vec3>& coefficients,
                               const std::vector<glm::vec3>& texture);

}  // namespace relief
