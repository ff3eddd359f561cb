// The coefficients of a texture's continuous function on splats.
#pragma once

#include <Eigen/SparseCore>
#include <glm/vec3.hpp>
#include <vector>

#include "common/progress.h"
#include "preprocess/texture/acquisition/acquisition.h"

namespace relief {

/// A basis at places that stand for equal shares of the surface: inner products over the surface
/// are means over the places.
using BasisAtPlaces = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// View-independent EWA (paper 000, section 5): w_k = <r_k, texture> / <r_k, 1>, as if the basis
/// were orthogonal. `texture`: its values at the places. A splat that no place sees gets its value
/// of `fallback`.
[[nodiscard]] std::vector<glm::vec3> project_texture(const BasisAtPlaces& basis,
                                                     const std::vector<glm::vec3>& texture,
                                                     const std::vector<glm::vec3>& fallback);

/// The matrix R of Eq. (11): the inner products of the basis functions, as means over the places.
[[nodiscard]] Eigen::SparseMatrix<double, Eigen::RowMajor> inner_products(
    const BasisAtPlaces& basis);

/// The optimised coefficients (paper 000, section 5 and appendix A): R w = c, whose solution has
/// the least L2 error against the texture. Starts from `start`, which stays where no place sees a
/// splat. Stops early, with what it has, when `progress` is cancelled.
[[nodiscard]] std::vector<glm::vec3> fit_texture(const BasisAtPlaces& basis,
                                                 const std::vector<glm::vec3>& texture,
                                                 const std::vector<glm::vec3>& start,
                                                 const Progress& progress, FitReport& report);

/// The L2 error of Eq. (10) as an rms over the surface and the three channels: texture units.
[[nodiscard]] double rms_error(const BasisAtPlaces& basis,
                               const std::vector<glm::vec3>& coefficients,
                               const std::vector<glm::vec3>& texture);

}  // namespace relief
