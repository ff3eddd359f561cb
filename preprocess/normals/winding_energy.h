// How far the winding numbers of a surface are from those that it should have.
#pragma once

#include <Eigen/Core>

#include "preprocess/normals/winding_numbers.h"

namespace relief {

/// Terms of a SideEnergy: the squared errors of winding numbers about places, over the places'
/// area. [Lin 2024] asks for a half about a closed surface that faces outward. Places on an open
/// ground that faces up see half a sphere of it from above, which counts minus a half: there, and
/// about bodies on it, the number is 0.
struct WindingTerms {
  Eigen::MatrixXf pairs;   ///< of the surface's pieces, with a diagonal of 0
  Eigen::VectorXf others;  ///< fields by what there is beside the surface
  Eigen::VectorXf number;  ///< fields, for each unit of the number that places should have
};

/// `numbers`: of pieces about places, as winding_numbers() has them. `others`: of what there is
/// beside these pieces.
[[nodiscard]] WindingTerms winding_terms(Eigen::MatrixXf numbers, const SurfacePlaces& places,
                                         const Eigen::VectorXf& others);

}  // namespace relief
