// Moving least squares over a base plane (paper 001, section 3.1; Alexa et al. 2003).
#pragma once

#include "preprocess/resample/point_grid.h"

namespace relief {

/// The MLS surface above one spot of the base plane.
struct SurfacePoint {
  double height = 0.0;            ///< world units along the plane's normal
  glm::vec3 fitted_normal{0.0F};  ///< of the fitted surface, unit, patch frame
  glm::vec3 given_normal{0.0F};   ///< the points' normals, fitted likewise, unit, patch frame
};

/// Evaluates the surface above (x, y): a polynomial of order 2 in the plane's coordinates, fitted
/// to the points around with weights exp(-d^2 / s^2), d the distance in space to a first estimate
/// of the surface point and s a multiple of the scan's local spacing there. A ridge on the
/// second-order terms turns the fit into a plane where there are too few points. `spacing` is the
/// grid's: a scan much finer than the grid is averaged over about a cell. The place must be
/// supported (see support.h).
///
/// The estimate is that of the nearest of the points that `supporting` has; the fit uses all near
/// the surface that `all` has. The others are no estimate: a wall that the base plane sees edge-on
/// has all its points, from top to bottom, at one place of it.
[[nodiscard]] SurfacePoint evaluate_mls(const PatchPoints& points, const PointGrid& supporting,
                                        const PointGrid& all, double x, double y, double spacing);

}  // namespace relief
