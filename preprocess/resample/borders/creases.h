// Creases at the border of a region: where the surface turns sharply into another region's.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "preprocess/normals/crease_sides.h"
#include "preprocess/resample/scan_surface.h"
#include "preprocess/resample/surroundings/patch_points.h"
#include "preprocess/resample/surroundings/point_grid.h"

namespace relief {

/// A crease near a position. Patch frame.
struct Crease {
  CreaseSide own;  ///< of the region's surface beside it
  /// From the position along the region's surface to the other one's tangent plane, world units;
  /// negative beyond it.
  double distance = 0.0;
};

/// The creases between a region and those around it.
class RegionCreases {
 public:
  /// `points`: the region's, as collect_patch_points() gives them; `reach`: how far points of both
  /// sides may be from a position, world units. The scan has `creases`.
  RegionCreases(const ScanSurface& scan, const Region& region, const PatchPoints& points,
                double reach);

  /// Whether the region has points at creases; if not, the rest is not to be called.
  [[nodiscard]] bool any() const { return beyond_.has_value(); }

  /// The crease within reach of a position on the region's surface, if there is one: points of both
  /// sides have normals that agree among each other and turn by more than 35 degrees between them.
  /// `normal`: about that of the surface there.
  [[nodiscard]] std::optional<Crease> near(glm::dvec3 position, glm::vec3 normal) const;

  /// The region's points and those about them, each with the normal of its own side.
  [[nodiscard]] const PatchPoints& points() const { return points_; }
  [[nodiscard]] const PointGrid& own() const { return *own_; }

 private:
  double reach_;
  PatchPoints points_;
  PatchPoints others_;  ///< of other regions, whatever their normals, by graph within reach
  std::optional<PointGrid> own_;
  std::optional<PointGrid> beyond_;
};

}  // namespace relief
