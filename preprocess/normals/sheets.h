// Sheets of points whose normals agree with each other, and which side of them is outside.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "common/points.h"

namespace relief {

/// Which points are connected, so that their normals could be made to agree.
struct Sheets {
  std::vector<std::uint32_t> of_point;  ///< empty if normals were taken as they are
  std::uint32_t count = 0;
};

/// What tells a sheet's outer side; sums over its points, so that those of a sheet's parts add up.
/// Places are relative to a base, the same for all that is added.
struct SheetSums {
  double area = 0.0;            ///< world units squared
  glm::dvec3 moment{0.0};       ///< area times place
  glm::dvec3 area_normal{0.0};  ///< area times normal
  double flux = 0.0;            ///< area times normal times place
  double to_viewpoint = 0.0;    ///< area times normal times unit direction to the viewpoint

  /// Adds a sheet whose normals are turned round first, if `turned`.
  void add(const SheetSums& other, bool turned);
};

/// The sums over the first `count` points of each sheet; normals are unit. `spacing` is the points'
/// local one, world units.
[[nodiscard]] std::vector<SheetSums> sum_up(const Points& points, std::size_t count,
                                            std::span<const glm::vec3> normals,
                                            std::span<const float> spacing, const Sheets& sheets,
                                            const glm::dvec3& base);

/// Whether a sheet's normals are to be turned round so that they face the viewpoint, if there is
/// one, otherwise outward: positive flux about the centroid, exact for closed surfaces; open sheets
/// that hardly bend, as terrains, face +Z.
[[nodiscard]] bool faces_inward(const SheetSums& sheet, bool has_viewpoint);

}  // namespace relief
