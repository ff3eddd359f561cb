#include "common/transform.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat4x4.hpp>
#include <glm/trigonometric.hpp>
#include <iterator>
#include <utility>

namespace relief {
namespace {

bool is_finite(glm::dvec3 v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Neither 0, nor subnormal, nor infinite in single precision.
bool fits_float(double value) {
  return std::isnormal(static_cast<float>(value));
}

glm::dvec3 moved(const Transform& transform, glm::dvec3 p) {
  return transform.translation + transform.scale * (transform.rotation * p);
}

Bounds moved_bounds(const Transform& transform, const Bounds& bounds, double new_radius) {
  if (bounds.empty()) return bounds;
  const glm::dvec3 centre = moved(transform, 0.5 * (bounds.min + bounds.max));
  // How far a turned box reaches along each axis, but no farther than the sphere.
  const glm::dvec3 half = 0.5 * transform.scale * (bounds.max - bounds.min);
  glm::dvec3 reach(0.0);
  for (glm::length_t axis = 0; axis < 3; ++axis) {
    for (glm::length_t side = 0; side < 3; ++side)
      reach[axis] += std::abs(transform.rotation[side][axis]) * half[side];
  }
  reach = glm::min(reach, glm::dvec3(new_radius));
  return {centre - reach, centre + reach};
}

}  // namespace

glm::dmat3 rotation_about(glm::dvec3 axis, double degrees) {
  return glm::dmat3(glm::rotate(glm::dmat4(1.0), glm::radians(degrees), axis));
}

Status transform_model(PatchModel& model, const Transform& transform) {
  for (Patch& patch : model.patches) {
    patch.origin = moved(transform, patch.origin);
    patch.axes = transform.rotation * patch.axes;
    patch.spacing *= transform.scale;
    patch.height_step *= transform.scale;
    if (!fits_float(patch.spacing) || !fits_float(patch.height_step) || !is_finite(patch.origin)) {
      return Error{"the transform makes it larger or smaller than numbers can say"};
    }
  }
  model.spacing *= transform.scale;
  model.bounding_radius *= transform.scale;
  model.bounds = moved_bounds(transform, model.bounds, model.bounding_radius);
  if (!std::isfinite(model.spacing) || !std::isfinite(model.bounding_radius) ||
      !is_finite(model.bounds.min) || !is_finite(model.bounds.max)) {
    return Error{"the transform makes it larger than numbers can say"};
  }
  return {};
}

void append_model(PatchModel& to, PatchModel from) {
  if (to.patches.empty()) {
    to = std::move(from);
    return;
  }
  if (from.patches.empty()) return;
  const Bounds both{glm::min(to.bounds.min, from.bounds.min),
                    glm::max(to.bounds.max, from.bounds.max)};
  const glm::dvec3 centre = 0.5 * (both.min + both.max);
  const auto reach = [centre](const PatchModel& model) {
    return glm::distance(centre, 0.5 * (model.bounds.min + model.bounds.max)) +
           model.bounding_radius;
  };
  to.bounding_radius =
      std::min(std::max(reach(to), reach(from)), 0.5 * glm::distance(both.min, both.max));
  to.bounds = both;
  to.spacing = std::min(to.spacing, from.spacing);
  to.has_colours = to.has_colours || from.has_colours;
  to.patches.insert(to.patches.end(), std::make_move_iterator(from.patches.begin()),
                    std::make_move_iterator(from.patches.end()));
}

}  // namespace relief
