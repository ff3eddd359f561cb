// A scalar field that is known at the nodes of a grid, or at points.
#pragma once

#include <array>
#include <cstddef>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <variant>
#include <vector>

#include "common/stance.h"

namespace relief {

/// A node (i, j, k) is at origin + step * (i, j, k).
struct RegularGrid {
  glm::dvec3 origin{0.0};
  glm::dmat3 step{1.0};  ///< columns: the steps along i, j and k, world units; not singular
};

/// A node (i, j, k) is at origin + axes * (coordinates[0][i], coordinates[1][j],
/// coordinates[2][k]).
struct RectilinearGrid {
  glm::dvec3 origin{0.0};
  glm::dmat3 axes{1.0};  ///< columns: directions of length 1; not singular
  std::array<std::vector<double>, 3> coordinates;  ///< strictly ascending, world units
};

/// A node has a position of its own, in the order of the values.
struct CurvilinearGrid {
  std::vector<glm::dvec3> positions;
};

/// No node has neighbours in a grid; the volume's size is (number of points, 1, 1). Arrays have one
/// element for each point.
struct ScatteredPoints {
  std::vector<glm::dvec3> positions;
  /// The cube root of each point's own share of space, world units; 0: it has none.
  std::vector<float> spacings;
  /// The spacing about each point: its neighbours' mean, world units.
  std::vector<float> widths;
  std::vector<glm::vec3> gradients;  ///< change of the value for a world unit
};

using VolumePlacement =
    std::variant<RegularGrid, RectilinearGrid, CurvilinearGrid, ScatteredPoints>;

/// A volume, world frame. Medical files come in right-anterior-superior coordinates, so that none
/// is the mirror image of another.
struct ScalarVolume {
  glm::uvec3 size{0};  ///< nodes along i, j and k; i varies fastest
  VolumePlacement placement;
  std::vector<float> values;  ///< size.x * size.y * size.z; NaN where there is no value
  Stance stance = kZUp;
};

/// The number of nodes.
[[nodiscard]] inline std::size_t nodes_of(const ScalarVolume& volume) {
  return std::size_t{volume.size.x} * volume.size.y * volume.size.z;
}

}  // namespace relief
