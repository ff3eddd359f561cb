// Models moved, turned and scaled, and put together.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "common/error.h"
#include "common/instance.h"
#include "common/patch.h"

namespace relief {

/// The rotation by an angle about an axis (any length but 0), counter-clockwise seen from the
/// axis's tip.
[[nodiscard]] glm::dmat3 rotation_about(glm::dvec3 axis, double degrees);

/// Where a patch lies (Patch).
struct PatchFrame {
  glm::dvec3 origin{0.0};
  glm::dmat3 axes{1.0};
  double spacing = 1.0;
  double height_step = 1.0;
};

/// Where a transform takes it.
[[nodiscard]] PatchFrame moved(const Transform& transform, const Patch& patch);

/// Moves a model. Only the patches' frames and steps change, so that it is as exact as double
/// precision, whatever the model's size. The new bounds are a box about the transformed one and the
/// transformed sphere: they have its very middle, but may be larger than the points need.
/// Fails, with a clause, if a patch's steps leave what single precision holds (the renderer keeps
/// them so) or its place what double precision holds.
Status transform_model(PatchModel& model, const Transform& transform);

/// Appends the patches of `from`; their ids count on after those of `to`. A patch without colours
/// stays without, and is drawn in the neutral grey beside coloured ones. The bounds become the box
/// about both; the bounding sphere is one about both spheres, no larger than the box's. `spacing`
/// becomes the finer one. Several closed models are together closed.
void append_model(PatchModel& to, PatchModel from);

/// Puts patches of the model in one more place. `extent`: their bounds, sphere, spacing, whether
/// they have colours and are closed, before they are placed; no patches. A model with instances
/// stands where they say and nowhere else. Fails as transform_model() does.
Status add_instance(PatchModel& to, const Instance& instance, const PatchModel& extent);

/// Each patch in each of its places, a patch of its own: for what knows no instances.
[[nodiscard]] PatchModel bake(const PatchModel& model);

/// All but the patches and their instances.
[[nodiscard]] PatchModel without_patches(const PatchModel& model);

}  // namespace relief
