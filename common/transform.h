// Transforms models, and joins several into one.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "common/error.h"
#include "common/instance.h"
#include "common/patch.h"

namespace relief {

/// Returns the rotation by an angle about an axis (any length but 0), counter-clockwise seen from
/// the axis's tip.
[[nodiscard]] glm::dmat3 rotation_about(glm::dvec3 axis, double degrees);

/// The frame of a patch, as in Patch.
struct MovedFrame {
  glm::dvec3 origin{0.0};
  glm::dmat3 axes{1.0};
  double spacing = 1.0;
  double height_step = 1.0;
};

/// Returns the transformed frame.
[[nodiscard]] MovedFrame moved(const Transform& transform, const Patch& patch);

/// Transforms a model. Only the patches' frames and steps change, so that the result is exact to
/// double precision for any model size. The new bounds are a box about the transformed bounds, with
/// their exact centre; they may be larger than the points need. Fails, with a clause, if a patch's
/// steps leave the range of single precision (which the renderer uses) or its position that of
/// double precision.
Status transform_model(PatchModel& model, const Transform& transform);

/// Appends the runs of `from`, whose patches are about to be appended, that meet at seams.
void append_joined(PatchModel& to, const PatchModel& from);

/// Appends the patches of `from`; their ids continue after those of `to`. A patch without colours
/// stays without, and is drawn in neutral grey beside coloured ones. The bounds become the box
/// about both. The bounding sphere becomes one about both spheres, no larger than the box's.
/// `spacing` becomes the finer one. The result is closed if both are.
void append_model(PatchModel& to, PatchModel from);

/// Extends the bounds, the sphere, the spacing and the attributes of a model for another one; takes
/// none of its patches. Models that stand in different ways have the default stance together.
void extend_extent(PatchModel& to, const PatchModel& from);

/// Adds an instance of some of the model's patches. `extent` has no patches; it gives their bounds,
/// sphere, spacing, and whether they have colours and are closed, before the transform. A model
/// with instances is drawn only through them. Fails as transform_model() does.
Status add_instance(PatchModel& to, const Instance& instance, const PatchModel& extent);

/// Returns the model with each instance as patches of its own, for code that knows no instances.
[[nodiscard]] PatchModel bake(const PatchModel& model);

/// Returns a copy without patches and instances.
[[nodiscard]] PatchModel without_patches(const PatchModel& model);

}  // namespace relief
