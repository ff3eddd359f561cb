#include "common/transform.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat4x4.hpp>
#include <glm/trigonometric.hpp>
#include <iterator>
#include <utility>

#include "common/extremes.h"
#include "common/is_finite.h"

namespace relief {
namespace {

/// Neither 0, nor subnormal, nor infinite in single precision.
bool fits_float(double value) {
  return std::isnormal(static_cast<float>(value));
}

Bounds moved_bounds(const Transform& transform, const Bounds& bounds, double new_radius) {
  if (bounds.empty()) return bounds;
  const glm::dvec3 centre = moved(transform, 0.5 * (bounds.min + bounds.max));
  // Returns the extent of a rotated box along each axis, limited by the sphere.
  const glm::dvec3 half = 0.5 * transform.scale * (bounds.max - bounds.min);
  glm::dvec3 reach(0.0);
  for (glm::length_t axis = 0; axis < 3; ++axis) {
    for (glm::length_t side = 0; side < 3; ++side)
      reach[axis] += std::abs(transform.rotation[side][axis]) * half[side];
  }
  reach = glm::min(reach, glm::dvec3(new_radius));
  return {centre - reach, centre + reach};
}

Status check_frame(const MovedFrame& frame) {
  if (fits_float(frame.spacing) && fits_float(frame.height_step) && is_finite(frame.origin))
    return {};
  return Error{"the transform makes it too large or too small for single precision"};
}

void set_frame(Patch& patch, const MovedFrame& frame) {
  patch.origin = frame.origin;
  patch.axes = frame.axes;
  patch.spacing = frame.spacing;
  patch.height_step = frame.height_step;
}

/// Adds another model's extreme points; of models that have none, the corners of their bounds.
void extend_extremes(PatchModel& to, const PatchModel& from) {
  if (to.extremes.empty()) to.extremes = corners_of(to.bounds);
  const auto more = from.extremes.empty() ? corners_of(from.bounds) : from.extremes;
  to.extremes.insert(to.extremes.end(), more.begin(), more.end());
}

}  // namespace

void extend_extent(PatchModel& to, const PatchModel& from) {
  if (from.bounds.empty()) return;
  to.has_colours = to.has_colours || from.has_colours;
  to.has_label_colours = to.has_label_colours || from.has_label_colours;
  if (to.bounds.empty()) {
    to.bounds = from.bounds;
    to.bounding_radius = from.bounding_radius;
    to.spacing = from.spacing;
    to.extremes = from.extremes;
    to.stance = from.stance;
    return;
  }
  extend_extremes(to, from);
  if (to.stance != from.stance) to.stance = Stance{};
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
}

glm::dmat3 rotation_about(glm::dvec3 axis, double degrees) {
  return glm::dmat3(glm::rotate(glm::dmat4(1.0), glm::radians(degrees), axis));
}

MovedFrame moved(const Transform& transform, const Patch& patch) {
  return {moved(transform, patch.origin), transform.rotation * patch.axes,
          patch.spacing * transform.scale, patch.height_step * transform.scale};
}

Status transform_model(PatchModel& model, const Transform& transform) {
  assert(model.instances.empty() && "patches that stand where they are");
  for (Patch& patch : model.patches) {
    const MovedFrame frame = moved(transform, patch);
    RELIEF_TRY(check_frame(frame));
    set_frame(patch, frame);
  }
  model.spacing *= transform.scale;
  model.bounding_radius *= transform.scale;
  model.bounds = moved_bounds(transform, model.bounds, model.bounding_radius);
  for (glm::dvec3& point : model.extremes) point = moved(transform, point);
  model.stance.up = transform.rotation * model.stance.up;
  model.stance.front = transform.rotation * model.stance.front;
  if (!std::isfinite(model.spacing) || !std::isfinite(model.bounding_radius) ||
      !is_finite(model.bounds.min) || !is_finite(model.bounds.max)) {
    return Error{"the transform makes it too large for double precision"};
  }
  return {};
}

void append_joined(PatchModel& to, const PatchModel& from) {
  const auto before = static_cast<std::uint32_t>(to.patches.size());
  for (const PatchRun& run : from.joined)
    to.joined.push_back({before + run.first, run.count, run.is_closed});
}

void append_model(PatchModel& to, PatchModel from) {
  assert(to.instances.empty() && from.instances.empty() && "patches that stand where they are");
  extend_extent(to, from);
  to.is_closed = from.is_closed && (to.patches.empty() || to.is_closed);
  append_joined(to, from);
  if (to.patches.empty()) {
    to.patches = std::move(from.patches);
    return;
  }
  to.patches.insert(to.patches.end(), std::make_move_iterator(from.patches.begin()),
                    std::make_move_iterator(from.patches.end()));
}

Status add_instance(PatchModel& to, const Instance& instance, const PatchModel& extent) {
  assert(instance.first + std::size_t{instance.count} <= to.patches.size() && "a run of patches");
  for (std::uint32_t k = 0; k < instance.count; ++k) {
    RELIEF_TRY(check_frame(moved(instance.transform, to.patches[instance.first + k])));
  }
  PatchModel placed = extent;
  RELIEF_TRY(transform_model(placed, instance.transform));
  extend_extent(to, placed);
  to.instances.push_back(instance);
  to.instances.back().is_closed = extent.is_closed;
  return {};
}

PatchModel bake(const PatchModel& model) {
  if (model.instances.empty()) return model;
  PatchModel baked = without_patches(model);
  baked.is_closed = std::all_of(model.instances.begin(), model.instances.end(),
                                [](const Instance& instance) { return instance.is_closed; });
  for (const Instance& instance : model.instances) {
    const auto before = static_cast<std::uint32_t>(baked.patches.size());
    for (const PatchRun& run : model.joined) {
      if (run.first >= instance.first && run.first < instance.first + instance.count)
        baked.joined.push_back({before + (run.first - instance.first), run.count, run.is_closed});
    }
    for (std::uint32_t k = 0; k < instance.count; ++k) {
      const Patch& patch = model.patches[instance.first + k];
      baked.patches.push_back(patch);
      baked.patches.back().material = instance.material;
      set_frame(baked.patches.back(), moved(instance.transform, patch));
    }
  }
  return baked;
}

PatchModel without_patches(const PatchModel& model) {
  PatchModel extent;
  extent.spacing = model.spacing;
  extent.bounds = model.bounds;
  extent.bounding_radius = model.bounding_radius;
  extent.extremes = model.extremes;
  extent.stance = model.stance;
  extent.has_colours = model.has_colours;
  extent.has_label_colours = model.has_label_colours;
  extent.is_closed = model.is_closed;
  return extent;
}

}  // namespace relief
