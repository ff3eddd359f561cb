// Sheets of points with consistent normals, and their outer sides.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/points.h"

namespace relief {

/// The sheet of each point: connected points whose normals agree.
struct Sheets {
  std::vector<std::uint32_t> of_point;  ///< empty if the given normals were used
  std::uint32_t count = 0;
};

/// Sums over a sheet's points that determine its outer side. Sums of a sheet's parts add up.
/// Positions are relative to a base, which all summands share.
struct SheetSums {
  double points = 0.0;          ///< their number
  double area = 0.0;            ///< world units squared
  glm::dvec3 moment{0.0};       ///< area times position
  glm::dvec3 area_normal{0.0};  ///< area times normal
  double flux = 0.0;            ///< area times normal times position
  double kept_area = 0.0;       ///< area whose side is as chosen; negative: most is turned

  /// Adds a sheet; `turned`: with its normals flipped.
  void add(const SheetSums& other, bool turned);
};

/// Returns the sums over the first `count` points of each sheet. Normals are unit. `spacing`: local
/// spacing of the points, world units.
[[nodiscard]] std::vector<SheetSums> sum_up(const Points& points, std::size_t count,
                                            std::span<const glm::vec3> normals,
                                            std::span<const float> spacing, const Sheets& sheets,
                                            const glm::dvec3& base);

/// Returns whether the normals of sheets that were joined must be flipped: if they enclose
/// something, to face outward (positive flux about the centroid, which is exact for closed
/// surfaces); otherwise so that most of the area faces the side that was chosen for it.
[[nodiscard]] bool faces_inward(const SheetSums& sheet);

}  // namespace relief
