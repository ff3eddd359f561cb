// The camera that all engines share.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "common/stance.h"

namespace relief {

/// A camera in world coordinates, looking from `eye` to `target`: a perspective one, or an
/// orthographic one, whose rays are all parallel to that line and begin in the plane through `eye`
/// across it. What is behind that plane is not seen; otherwise the distance does not count.
struct Camera {
  glm::dvec3 eye{0.0, 0.0, 1.0};
  glm::dvec3 target{0.0};
  glm::dvec3 up{0.0, 1.0, 0.0};
  double vertical_fov_degrees = 45.0;  ///< ignored by an orthographic one
  double orthographic_height = 0.0;    ///< of the image, world units; above 0: orthographic

  [[nodiscard]] bool is_orthographic() const { return orthographic_height > 0.0; }

  bool operator==(const Camera&) const = default;
};

/// The position of a camera on an orbit about a model that stands (common/stance.h): azimuth 0 is
/// in front and turns to the model's left hand, which is the image's right; elevation lifts up.
struct Orbit {
  double azimuth_degrees = 0.0;
  double elevation_degrees = 0.0;
  double distance_in_radii = 0.0;  ///< 0: the bounding sphere just fits the smaller field of view
};

/// The camera of an orbit about a sphere (world units) for an image of `aspect` = width / height.
[[nodiscard]] Camera orbit_camera(glm::dvec3 centre, double radius, const Orbit& orbit,
                                  double vertical_fov_degrees, double aspect,
                                  const Stance& stance = {});

/// The same camera turned about its line of sight, counter-clockwise as seen from the eye, so that
/// the image turns clockwise.
[[nodiscard]] Camera rolled(const Camera& camera, double degrees);

/// The same camera with an image that shows its middle so many times as large.
[[nodiscard]] Camera zoomed(const Camera& camera, double factor);

/// The rotation from world to eye coordinates (x right, y up, z backward). Its translation is left
/// out on purpose: positions are made relative to the eye in double precision first.
[[nodiscard]] glm::dmat3 view_rotation(const Camera& camera);

/// Projection from eye to clip coordinates with reversed depth in [0, 1] and an infinite far plane
/// (depth = near / distance).
[[nodiscard]] glm::mat4 reversed_infinite_projection(double vertical_fov_degrees, double aspect,
                                                     double near);

/// The visible box of an orthographic camera, in eye coordinates: half the image's sides, and the
/// depths (world units along the view axis) between which depth values fall from 1 to 0.
struct OrthographicBox {
  double half_width = 1.0;
  double half_height = 1.0;
  double near = 0.0;
  double far = 1.0;
};

/// Projection from eye to clip coordinates with reversed depth, linear from 1 at `near` to 0 at
/// `far`. All clip coordinates have w = 1.
[[nodiscard]] glm::dmat4 reversed_orthographic_projection(const OrthographicBox& box);

}  // namespace relief
