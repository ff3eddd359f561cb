// Winding numbers of pieces of a surface about places on it.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace relief {

/// Points of a surface, piece by piece.
struct PiecedSurface {
  std::vector<glm::vec3> positions;     ///< about a centre of the scan, world units
  std::vector<glm::vec3> area_normals;  ///< unit normal times area, world units squared
  std::vector<std::uint32_t> first;     ///< each piece's first point, and the number of all

  /// The number of pieces.
  [[nodiscard]] std::size_t count() const { return first.size() - 1; }
};

/// Places on a surface, and the area that each stands for, world units squared.
struct SurfacePlaces {
  std::vector<glm::vec3> positions;
  std::vector<float> areas;
};

/// Returns the areas of the pieces, world units squared.
[[nodiscard]] std::vector<float> areas_of(const PiecedSurface& surface);

/// Returns `per_piece` points of each piece, or all if it has fewer, evenly over their order.
[[nodiscard]] SurfacePlaces places_on(const PiecedSurface& surface, std::size_t per_piece);

/// A piece seen from afar.
struct PieceDipole {
  glm::vec3 centre{0.0F};
  glm::vec3 area_normal{0.0F};
  float squared_reach = 0.0F;  ///< beyond it, the dipole stands for its piece
};

[[nodiscard]] std::vector<PieceDipole> dipoles_of(const PiecedSurface& surface);

/// Returns the winding number of each piece (column) about each place (row): the share of all
/// directions in which the place sees the piece, negative if it sees the side that normals point
/// to. All pieces of a closed surface have a half together. A far piece is one dipole and a near
/// one its points, which are discs ([Barill 2018]). The result does not depend on the number of
/// threads.
[[nodiscard]] Eigen::MatrixXf winding_numbers(const PiecedSurface& surface,
                                              const SurfacePlaces& places);

/// Returns the winding number of all pieces about each place. `sides`: 1, -1 for pieces turned over
/// and 0 for those that do not count. `dipoles`: those of the surface.
[[nodiscard]] Eigen::VectorXf total_winding_numbers(const PiecedSurface& surface,
                                                    const std::vector<PieceDipole>& dipoles,
                                                    const Eigen::VectorXf& sides,
                                                    const SurfacePlaces& places);

}  // namespace relief
