// Where a scan ends: about its outside and the holes in it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "common/neighbours/radius_search.h"
#include "preprocess/partition/partition.h"

namespace relief {

/// The open borders of a scan, about its outside and about holes, as curves along points.
///
/// A point is at a border if its neighbours leave a wide sector of its tangent plane empty, whose
/// middle points outward, and nothing follows there. Between such points the border is a mean of
/// them, weighted by distance and direction (as surfaces are of points with normals: [Oeztireli
/// 2009], "Feature Preserving Point Set Surfaces based on Non-Linear Kernel Regression"). So it has
/// corners, but not the raggedness of a random scan's last points.
class ScanBorder {
 public:
  /// `of_others`: points from here on are of other tiles, about which too little is known.
  ScanBorder(const SurfaceSamples& samples, const NeighbourGraph& graph, std::uint32_t of_others);

  [[nodiscard]] bool empty() const { return points_.empty(); }
  /// How many points are at borders, without those at sharp edges, of which some look like it.
  [[nodiscard]] std::size_t count() const { return count_; }

  /// How far a position on the scan's surface lies beyond its border; negative: before it. World
  /// units. Nothing if no border is near. `normal`: of the surface there; `spacing`: of the scan
  /// there.
  [[nodiscard]] std::optional<double> beyond(glm::dvec3 position, glm::vec3 normal,
                                             double spacing) const;

 private:
  struct Point {
    glm::dvec3 position{0.0};
    glm::vec3 normal{0.0F};   ///< of the surface
    glm::vec3 outward{0.0F};  ///< in the tangent plane
  };

  std::vector<Point> points_;
  std::size_t count_ = 0;
  std::optional<RadiusSearch> search_;
};

}  // namespace relief
