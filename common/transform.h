// Models moved, turned and scaled, and put together.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "common/error.h"
#include "common/patch.h"

namespace relief {

/// A similarity: scaled, then turned, then moved. The point p goes to
///   translation + scale * (rotation * p).
struct Transform {
  glm::dvec3 translation{0.0};  ///< world units
  glm::dmat3 rotation{1.0};     ///< orthonormal, right-handed
  double scale = 1.0;           ///< above 0
};

/// The rotation by an angle about an axis (any length but 0), counter-clockwise seen from the
/// axis's tip.
[[nodiscard]] glm::dmat3 rotation_about(glm::dvec3 axis, double degrees);

/// Moves a model. Only the patches' frames and steps change, so that it is as exact as double
/// precision, whatever the model's size. The new bounds are a box about the transformed one and the
/// transformed sphere: they have its very middle, but may be larger than the points need.
/// Fails, with a clause, if a patch's steps leave what single precision holds (the renderer keeps
/// them so) or its place what double precision holds.
Status transform_model(PatchModel& model, const Transform& transform);

/// Appends the patches of `from`; their ids count on after those of `to`. A patch without colours
/// stays without, and is drawn in the neutral grey beside coloured ones. The bounds become the box
/// about both; the bounding sphere is one about both spheres, no larger than the box's. `spacing`
/// becomes the finer one.
void append_model(PatchModel& to, PatchModel from);

}  // namespace relief
