// From a raster's coordinates to the world.
#pragma once

#include <glm/vec2.hpp>
#include <string>

namespace relief {

/// Cells in the coordinate system of a file: x east, y north. The centre of the cell (column, row)
/// is at (x + column * dx, y - row * dy).
struct GeoGrid {
  double x = 0.0;  ///< centre of the cell in the north-west
  double y = 0.0;
  double dx = 1.0;  ///< above 0
  double dy = 1.0;
  bool in_degrees = false;
  double semi_major = 6378137.0;              ///< of the ellipsoid, metres; WGS 84
  double inverse_flattening = 298.257223563;  ///< 0: a sphere
  std::string system;  ///< the coordinate system's definition, for comparison; may be empty
};

/// Maps a file's coordinates to the world: world = (file - centre) * factor.
struct GeoFrame {
  glm::dvec2 centre{0.0};
  glm::dvec2 factor{1.0};
  glm::dvec2 cell{1.0};  ///< sides of a cell, world units
  double stretch = 1.0;  ///< of x, so that cells become square; 1: none

  [[nodiscard]] glm::dvec2 world(glm::dvec2 file) const { return (file - centre) * factor; }
};

/// The most that x is stretched to make cells square.
inline constexpr double kLargestStretch = 0.01;

/// Returns the frame of a grid. Degrees become metres about the grid's centre: x by the parallel
/// through it and y by its meridian, on the ellipsoid (a local equirectangular map). If cells are
/// then square within kLargestStretch, x is stretched to make them so: the map is true along a
/// parallel nearby. Other grids keep their coordinates.
[[nodiscard]] GeoFrame frame_of(const GeoGrid& grid, double columns, double rows);

}  // namespace relief
