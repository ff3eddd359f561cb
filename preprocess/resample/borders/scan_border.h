// Where a scan ends: about its outside and the holes in it.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "common/neighbours/radius_search.h"
#include "preprocess/partition/partition.h"

namespace relief {

/// The open borders of a scan, as a curve that is fitted to the points along them.
///
/// A point is at a border if no other lies in a sector of its tangent plane, of 150 degrees or more
/// and 2.5 spacings: outward is along the middle of it. Where there are two such sectors, as along
/// a wire, or none but a small one is filled, as at its end, it has no side and is left out.
/// Between the points the curve is that of moving least squares with their directions (as surfaces
/// from points with normals: [Oeztireli 2009], "Feature Preserving Point Set Surfaces based on
/// Non-Linear Kernel Regression"), which averages what is random of a scan's last points and keeps
/// corners.
class ScanBorder {
 public:
  /// `of_others`: points from here on are of other tiles, about which too little is known.
  ScanBorder(const SurfaceSamples& samples, const NeighbourGraph& graph, std::uint32_t of_others);

  [[nodiscard]] bool empty() const { return points_.empty(); }

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
  std::optional<RadiusSearch> search_;
};

}  // namespace relief
