// Moving least squares over a base plane ([Ochotta 2008], section 3.1; Alexa et al. 2003).
#pragma once

#include <glm/vec2.hpp>
#include <optional>

#include "preprocess/resample/surroundings/point_grid.h"

namespace relief {

/// The MLS surface above one position of the base plane.
struct MlsPoint {
  double height = 0.0;            ///< world units along the plane's normal
  glm::vec3 fitted_normal{0.0F};  ///< of the fitted surface, unit, patch frame
  glm::vec3 given_normal{0.0F};   ///< fitted to the points' normals, unit, patch frame, or 0
  /// The fit left the points' own tangent planes, or there were too few points: the height is the
  /// mean of those planes' (or the nearest's), the normal that of the points.
  bool is_replaced = false;
  double condition = 1.0;                    ///< of the fit's equations (FitEquations::condition)
  std::uint32_t nearest = PointGrid::kNone;  ///< that gave the first estimate
};

/// Evaluates the surface above (x, y): a polynomial of order 2 in the plane's coordinates, fitted
/// to surrounding points with weights exp(-d^2 / s^2), d the distance in space to a first estimate
/// of the surface point and s a multiple of the scan's local spacing there. A ridge on the
/// second-order terms turns the fit into a plane if there are too few points. `spacing` is the
/// grid's: a scan much finer than the grid is averaged over about a cell. The position must be
/// supported (see support.h).
///
/// The estimate comes from the nearest point of `supporting`; the fit uses all points of `all` near
/// the surface. Other points give no estimate: all points of a wall perpendicular to the base plane
/// lie at one position of it. `with_given_normal`: that takes a third of the time.
[[nodiscard]] MlsPoint evaluate_mls(const PatchPoints& points, const PointGrid& supporting,
                                    const PointGrid& all, double x, double y, double spacing,
                                    bool with_given_normal);

/// Evaluates the surface above (x, y) as the mean of the tangent planes of the points about it:
/// first order, in a quarter of the time. For what is fitted to triangles afterwards.
[[nodiscard]] MlsPoint blend_tangents(const PatchPoints& points, const PointGrid& supporting,
                                      const PointGrid& all, double x, double y, double spacing);

/// Evaluates the surface on one side of a crease, which goes on beyond it: fits points whose
/// normals are near that side's `normal`, not their normals. Nothing if none of the region's own is
/// within `reach`.
[[nodiscard]] std::optional<MlsPoint> evaluate_mls_beside_crease(const PatchPoints& points,
                                                                 const PointGrid& own,
                                                                 const PointGrid& all,
                                                                 glm::dvec2 at, double reach,
                                                                 glm::vec3 normal, double spacing);

}  // namespace relief
