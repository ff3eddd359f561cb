#include "renderer/view/view.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <tuple>
#include <utility>

namespace relief {

namespace {

/// Beyond the model's bounds, which are those of its points: how much farther splats of `spacing`
/// may reach, or be set back (kBorderSetBack over the cosine of kSteepest, and kBlendingDepth).
constexpr double kSlackSpacings = 8.0;

/// The same as a part of the bounds' depth: samples are not where the points are.
constexpr double kSlackShare = 0.125;

/// The depths of an orthographic view that are told apart.
std::pair<double, double> depth_range(const View& view, const DepthNeeds& needs) {
  if (needs.bounds.empty()) return {0.0, 1.0};
  const glm::dvec3 backward = glm::transpose(view.rotation)[2];
  const glm::dvec3 middle = 0.5 * (needs.bounds.min + needs.bounds.max);
  const glm::dvec3 half = 0.5 * (needs.bounds.max - needs.bounds.min);
  const double depth = glm::dot(backward, view.eye - middle);
  const double size = glm::dot(glm::abs(backward), half);
  const double slack = kSlackShare * glm::length(half) + kSlackSpacings * needs.spacing;
  const double near = std::max(depth - size - slack, 0.0);
  const double far = std::max(depth + size + slack, near);
  if (!std::isfinite(far)) return {0.0, 1.0};  // bounds that a hostile file has
  // Nothing of it is seen, or it has no size: any range is good.
  return {near, far > near ? far : near + std::max(near, 1.0)};
}

/// Where the point at depth 1 that is seen at a window position lies right and up of the axis.
glm::dvec2 image_plane_position(const View& view, glm::dvec2 window) {
  const glm::dvec2 ndc = 2.0 * window / glm::dvec2(view.width, view.height) - 1.0;
  return view.middle + ndc * glm::dvec2(view.slope_x, view.slope_y);
}

}  // namespace

View make_view(const Camera& camera, std::uint32_t width, std::uint32_t height,
               const DepthNeeds& needs) {
  const double aspect = static_cast<double>(width) / height;
  View view;
  view.eye = camera.eye;
  view.rotation = view_rotation(camera);
  view.width = width;
  view.height = height;
  view.orthographic = camera.is_orthographic();
  if (view.orthographic) {
    view.slope_y = camera.orthographic_height / 2.0;
    view.slope_x = view.slope_y * aspect;
    std::tie(view.near, view.far) = depth_range(view, needs);
    view.projection =
        reversed_orthographic_projection({view.slope_x, view.slope_y, view.near, view.far});
    return view;
  }
  view.projection =
      glm::dmat4(reversed_infinite_projection(camera.vertical_fov_degrees, aspect, needs.near));
  view.near = needs.near;
  view.slope_y = std::tan(glm::radians(camera.vertical_fov_degrees) / 2.0);
  view.slope_x = view.slope_y * aspect;
  return view;
}

View view_of_part(const View& whole, const Raster& part) {
  const glm::dvec2 size(part.width, part.height);
  const glm::dvec2 share = size / glm::dvec2(whole.width, whole.height);
  const glm::dvec2 corner(part.left, part.bottom);
  // Of the whole image this is exactly 0, and the view the same to the last bit.
  const glm::dvec2 shift = (2.0 * corner + size) / glm::dvec2(whole.width, whole.height) - 1.0;
  View view = whole;
  view.slope_x = whole.slope_x * share.x;
  view.slope_y = whole.slope_y * share.y;
  view.middle = whole.middle + shift * glm::dvec2(whole.slope_x, whole.slope_y);
  for (glm::length_t c = 0; c < 4; ++c) {
    glm::dvec4& column = view.projection[c];
    column.x = (column.x - shift.x * column.w) / share.x;
    column.y = (column.y - shift.y * column.w) / share.y;
  }
  view.width = part.width * part.side;
  view.height = part.height * part.side;
  view.pixels_per_sample = whole.pixels_per_sample * part.side;
  view.proxy_diameter = whole.proxy_diameter * part.side;
  return view;
}

View with_border(const View& whole, std::uint32_t border) {
  View view = whole;
  view.width += 2 * border;
  view.height += 2 * border;
  const glm::dvec2 growth =
      glm::dvec2(view.width, view.height) / glm::dvec2(whole.width, whole.height);
  view.slope_x *= growth.x;
  view.slope_y *= growth.y;
  for (glm::length_t c = 0; c < 4; ++c) {
    view.projection[c].x /= growth.x;
    view.projection[c].y /= growth.y;
  }
  return view;
}

glm::dvec3 ray_through(const View& view, glm::dvec2 window) {
  if (view.orthographic) return glm::transpose(view.rotation) * glm::dvec3(0.0, 0.0, -1.0);
  return glm::transpose(view.rotation) * glm::dvec3(image_plane_position(view, window), -1.0);
}

glm::dvec3 ray_start(const View& view, glm::dvec2 window) {
  if (!view.orthographic) return glm::dvec3(0.0);
  return glm::transpose(view.rotation) * glm::dvec3(image_plane_position(view, window), 0.0);
}

double pixel_at(const View& view, double depth) {
  const double pixel = 2.0 * view.slope_y / view.height;
  return view.orthographic ? pixel : pixel * depth;
}

double nearest_depth(const View& view, glm::dvec3 centre, double radius) {
  return -(view.rotation * (centre - view.eye)).z - radius;
}

double nearest_pixel(const View& view, glm::dvec3 centre, double radius) {
  return pixel_at(view, nearest_depth(view, centre, radius));
}

double distance_to(const View& view, glm::dvec3 position) {
  if (!view.orthographic) return glm::distance(position, view.eye);
  return -(view.rotation * (position - view.eye)).z;
}

bool sees_sphere(const View& view, glm::dvec3 centre, double radius) {
  const glm::dvec3 c = view.rotation * (centre - view.eye);
  const double depth = -c.z;
  if (depth < -radius) return false;
  // Distance to a side plane through the eye; its inward normal is (-1, 0, -slope) normalised.
  const auto outside = [&view, depth, radius](double across, double slope) {
    if (view.orthographic) return across - slope > radius;
    return across - depth * slope > radius * std::sqrt(1.0 + slope * slope);
  };
  return !outside(c.x, view.middle.x + view.slope_x) &&
         !outside(-c.x, view.slope_x - view.middle.x) &&
         !outside(c.y, view.middle.y + view.slope_y) &&
         !outside(-c.y, view.slope_y - view.middle.y);
}

}  // namespace relief
