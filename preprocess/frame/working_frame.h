// The frame that a conversion computes in, so that its result does not depend on how a scan lies.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "common/patch.h"
#include "common/points.h"
#include "preprocess/convert_options.h"

namespace relief {

/// A frame in the world.
struct WorkingFrame {
  glm::dvec3 origin{0.0};
  glm::dmat3 axes{1.0};  ///< columns: orthonormal; left-handed where that is the scan's own

  bool operator==(const WorkingFrame&) const = default;
};

/// Returns the frame that turns with a scan, and is mirrored with it: its axes are the principal
/// axes of the points, from the longest on, each towards the side on which the points reach farther
/// (the third moment). Where moments do not tell axes apart, as of a sphere or a cube, the world's
/// axes stand in for them. A scan that has no axes of its own stays in the world frame.
[[nodiscard]] WorkingFrame working_frame(const std::vector<glm::dvec3>& positions);

// From the world frame to a working one.

/// Moves all positions and directions of a scan, and keeps triangles counter-clockwise; positions
/// are in working units (preprocess/frame/working_unit.h). How the scan stands remains as it is in
/// the world.
void to_working_frame(const WorkingFrame& frame, Points& points);
[[nodiscard]] SideChoice to_working_frame(const WorkingFrame& frame, SideChoice side);
[[nodiscard]] glm::dvec3 to_working_frame(const WorkingFrame& frame, const glm::dvec3& position);

/// Rounds a position in a frame, so that it is the same whichever way the scan lies. `unit`: about
/// as long as the scan is wide.
[[nodiscard]] glm::dvec3 on_steps(const glm::dvec3& in_frame, double unit = 1.0);

/// Moves patches from a working frame to the world's. They stay right-handed: from a left-handed
/// frame their rows become columns.
void to_world_frame(const WorkingFrame& frame, std::vector<Patch>& patches);

}  // namespace relief
