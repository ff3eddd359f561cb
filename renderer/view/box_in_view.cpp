#include "renderer/view/box_in_view.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace relief {
namespace {

/// The least that dot(direction, p - eye) is of a point p of the box.
double least_along(const View& view, const PlacedBox& placed, const glm::dvec3& direction) {
  const auto& [box, transform] = placed;
  const glm::dvec3 centre = moved(transform, 0.5 * (box.min + box.max));
  const glm::dvec3 half = 0.5 * transform.scale * (box.max - box.min);
  const glm::dvec3 in_model = glm::transpose(transform.rotation) * direction;
  return glm::dot(direction, centre - view.eye) - glm::dot(glm::abs(in_model), half);
}

/// How far the box is from the eye.
double distance_of(const View& view, const PlacedBox& placed) {
  const auto& [box, transform] = placed;
  const glm::dvec3 eye =
      glm::transpose(transform.rotation) * (view.eye - transform.translation) / transform.scale;
  return transform.scale * glm::distance(eye, glm::clamp(eye, box.min, box.max));
}

}  // namespace

bool sees_box(const View& view, const PlacedBox& placed, double reach) {
  const glm::dmat3 axes = glm::transpose(view.rotation);
  const glm::dvec3 backward = axes[2];
  if (least_along(view, placed, backward) > reach) return false;
  // Beyond a side plane; a perspective camera's goes through the eye.
  const auto is_outside = [&](const glm::dvec3& across, double slope) {
    if (view.orthographic) return least_along(view, placed, across) > slope + reach;
    const double length = std::sqrt(1.0 + slope * slope);
    return least_along(view, placed, across + slope * backward) > length * reach;
  };
  return !is_outside(axes[0], view.slope_x + view.middle.x) &&
         !is_outside(-axes[0], view.slope_x - view.middle.x) &&
         !is_outside(axes[1], view.slope_y + view.middle.y) &&
         !is_outside(-axes[1], view.slope_y - view.middle.y);
}

double nearest_depth(const View& view, const PlacedBox& placed) {
  const double depth = least_along(view, placed, -glm::transpose(view.rotation)[2]);
  if (view.orthographic) return depth;
  // The image's corners are seen the most obliquely.
  const glm::dvec2 corner = glm::abs(view.middle) + glm::dvec2(view.slope_x, view.slope_y);
  const double distance = distance_of(view, placed);
  return std::max(depth, distance / std::sqrt(1.0 + glm::dot(corner, corner)));
}

}  // namespace relief
