// The camera that all engines share.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "common/points.h"

namespace relief {

/// A perspective camera in world coordinates, looking from `eye` to `target`.
struct Camera {
  glm::dvec3 eye{0.0, 0.0, 1.0};
  glm::dvec3 target{0.0};
  glm::dvec3 up{0.0, 1.0, 0.0};
  double vertical_fov_degrees = 45.0;
};

/// Where a camera on an orbit stands. Azimuth 0 is +Z and turns to +X; elevation lifts to +Y.
struct Orbit {
  double azimuth_degrees = 0.0;
  double elevation_degrees = 0.0;
  double distance_in_radii = 0.0;  ///< 0: the bounding sphere just fits the smaller field of view
};

/// The camera of an orbit about a sphere (world units) for a picture of `aspect` = width / height.
[[nodiscard]] Camera orbit_camera(glm::dvec3 centre, double radius, const Orbit& orbit,
                                  double vertical_fov_degrees, double aspect);

/// The rotation from world to eye coordinates (x right, y up, z backward). Its translation is left
/// out on purpose: positions are made relative to the eye in double precision first.
[[nodiscard]] glm::dmat3 view_rotation(const Camera& camera);

/// Projection from eye to clip coordinates with reversed depth in [0, 1] and an infinite far plane
/// (depth = near / distance).
[[nodiscard]] glm::mat4 reversed_infinite_projection(double vertical_fov_degrees, double aspect,
                                                     double near);

}  // namespace relief
