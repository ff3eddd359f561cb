// A model that tests navigate about: a ball, whose surface is easily picked.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "common/extremes.h"
#include "common/patch.h"
#include "viewer/navigation/navigator.h"
#include "viewer/navigation/projection.h"

namespace relief {

/// A survey's coordinates: half the rounding of a position is 5e-10 there.
inline const glm::dvec3 kUtm{5e5, 5e6, 100.0};

/// Pixels by which a point that must not move may do so. At kUtm, a camera 250 units from the model
/// has pixels of 0.2 units and is rounded to 1e-9.
inline constexpr double kSamePixel = 1e-6;

inline constexpr ImageSize kImage{1280, 800};
inline const glm::dvec2 kSize{1280.0, 800.0};

struct Ball {
  glm::dvec3 centre{0.0};
  double radius = 100.0;
  double spacing = 0.1;
};

inline const Ball kBall{kUtm, 100.0, 0.1};

/// The extent of the box about a ball, with Z up.
inline PatchModel extent_of(const Ball& ball) {
  PatchModel extent;
  extent.bounds = {ball.centre - ball.radius, ball.centre + ball.radius};
  extent.bounding_radius = ball.radius;
  extent.extremes = corners_of(extent.bounds);
  extent.stance = kZUp;
  extent.spacing = ball.spacing;
  return extent;
}

inline Navigator navigator_about(const Ball& ball) {
  Navigator navigator;
  navigator.set_image(kImage);
  navigator.set_model(extent_of(ball), false);
  return navigator;
}

/// What a viewer picks: the point of the ball that is seen at a cursor.
inline std::optional<glm::dvec3> pick(const Ball& ball, const Camera& camera, glm::dvec2 cursor,
                                      glm::dvec2 size = kSize) {
  const Ray ray = ray_through(camera, cursor, size);
  const glm::dvec3 from = ray.origin - ball.centre;
  const double b = glm::dot(from, ray.direction);
  const double discriminant = b * b - (glm::dot(from, from) - ball.radius * ball.radius);
  if (discriminant < 0.0) return std::nullopt;
  const double distance = -b - std::sqrt(discriminant);
  if (distance <= 0.0) return std::nullopt;
  return ray.origin + distance * ray.direction;
}

/// How far apart, in pixels, a point is seen in two images.
inline double pixels_between(const Camera& a, const Camera& b, glm::dvec3 point) {
  const auto before = project(a, point, kSize);
  const auto after = project(b, point, kSize);
  return before && after ? glm::distance(*before, *after) : 1e300;
}

/// The largest shift of any of the corners of a ball's box between two images: a jump, if large.
inline double shift_between(const Camera& a, const Camera& b, const Ball& ball) {
  double most = 0.0;
  for (const glm::dvec3& p : extent_of(ball).extremes)
    most = std::max(most, pixels_between(a, b, p));
  return most;
}

inline glm::dvec3 right_of(const Camera& camera) {
  return glm::transpose(view_rotation(camera))[0];
}
inline glm::dvec3 up_of(const Camera& camera) {
  return glm::transpose(view_rotation(camera))[1];
}
inline glm::dvec3 backward_of(const Camera& camera) {
  return glm::transpose(view_rotation(camera))[2];
}

}  // namespace relief
