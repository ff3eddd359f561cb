// The points of a region and its surroundings, in the frame of the region's patch.
#pragma once

#include <algorithm>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <vector>

#include "preprocess/partition/partition.h"

namespace relief {

/// A base plane with its two directions: local = transpose(axes) * (world - origin).
struct PatchFrame {
  glm::dvec3 origin{0.0};
  glm::dmat3 axes{1.0};

  [[nodiscard]] glm::dvec3 to_local(glm::dvec3 world) const {
    return glm::transpose(axes) * (world - origin);
  }
};

/// Points in a patch frame (x, y on the base plane, z the height; world units): first the region's
/// own, then those of the overlap margin that support samples, then those too steep for that, which
/// only stabilise the fits.
struct PatchPoints {
  PatchFrame frame;
  std::size_t own = 0;             ///< number of points of the region
  std::size_t supporting = 0;      ///< number of points that support samples, own ones included
  std::vector<std::uint32_t> ids;  ///< indices into the scan
  std::vector<glm::dvec3> positions;
  std::vector<glm::vec3> normals;  ///< unit, in the patch frame; all face +z
  std::vector<float> spacing;      ///< local spacing of the scan
  /// Spacing that points of other regions have at least, where gaps between points are judged:
  /// beside a denser part, points are as far from it as from each other. 0: their own.
  float least_of_others = 0.0F;

  [[nodiscard]] std::size_t size() const { return ids.size(); }
};

/// The cosine of 84 degrees, the limit of all regions: slopes count as no steeper.
inline constexpr float kSteepestCosine = 0.1F;

/// Returns the gradient of a plane's height over the base plane.
[[nodiscard]] inline glm::dvec2 slope_of(glm::vec3 normal) {
  return glm::dvec2(normal) / double{std::max(normal.z, kSteepestCosine)};
}

/// Returns the height of a point's tangent plane above (x, y).
[[nodiscard]] inline double tangent_height(const PatchPoints& points, std::uint32_t point, double x,
                                           double y) {
  const glm::dvec3 p = points.positions[point];
  const glm::vec3 n = points.normals[point];
  const double steep = std::max(n.z, kSteepestCosine);
  return p.z - (n.x * (x - p.x) + n.y * (y - p.y)) / steep;
}

/// Adds the positions, normals and spacings of `ids`, in `frame`.
void place_points(const SurfaceSamples& samples, PatchPoints& points);

/// Collects a region's points and surrounding points of its sheet, up to `margin` world units away
/// on the base plane, through the neighbour graph (the papers' epsilon neighbourhood). The frame's
/// first two axes run along the smallest rectangle around the region's own points. `membership`
/// covers all points; it is not read if `margin` is 0, which collects no surroundings.
/// `own_spacing`: of the region's points, for which denser surroundings are also those so near as
/// sparse ones would be; 0 if the scan's density is even.
[[nodiscard]] PatchPoints collect_patch_points(const SurfaceSamples& samples,
                                               const NeighbourGraph& graph, const Region& region,
                                               const Membership& membership, double margin,
                                               float own_spacing = 0.0F);

}  // namespace relief
