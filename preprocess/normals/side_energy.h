// Chooses the sides of pieces of a surface, given how each pair and each piece would have them.
#pragma once

#include <Eigen/Core>

namespace relief {

/// The least area of a piece, world units squared: none is 0.
inline constexpr float kLeastPieceArea = 1e-30F;

/// An energy of sides s (1 or -1): -fields . s - s . pairs . s / 2. World units squared.
struct SideEnergy {
  Eigen::MatrixXf pairs;  ///< symmetric, with a diagonal of 0
  Eigen::VectorXf fields;
  Eigen::VectorXf areas;  ///< of the pieces, above 0
};

/// Returns the energy of sides.
[[nodiscard]] float energy_of(const SideEnergy& energy, const Eigen::VectorXf& sides);

/// Returns sides of low energy: joins the two pieces that are surest of each other, or a piece and
/// its field, again and again (greedy additive edge contraction, [Keuper 2015]). Sure is what
/// counts much for the smaller one's area. Then flips single pieces while that lowers the energy.
[[nodiscard]] Eigen::VectorXf choose_sides(const SideEnergy& energy);

}  // namespace relief
