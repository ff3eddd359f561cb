// Whether a mesh stands on the lower end of an axis, or would fall over.
#pragma once

#include "common/points.h"

namespace relief {

/// How a mesh stands with one of its axes up. Its lowest points are those in the lowest 2 % of its
/// height.
struct Footing {
  /// Of its bounding rectangle, seen from above: what lies between its lowest points (their convex
  /// hull).
  double share = 0.0;
  /// How far the centre of its area lies within that hull, over its height above them; below 0:
  /// outside, so that the mesh would fall over.
  double margin = 0.0;
};

/// Returns the footing of a mesh with axis 0, 1 or 2 up. All zero where it has no area. Vertices
/// without triangles do not count. Indices must be valid.
[[nodiscard]] Footing footing_of(const Points& mesh, int up);

/// Whether a mesh plainly stands with Z up and would fall over with Y up, which is usual. False for
/// what is flat: it may be a plaque or a terrain. Indices must be valid.
[[nodiscard]] bool stands_on_z(const Points& mesh);

}  // namespace relief
